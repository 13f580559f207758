// SPDX-License-Identifier: BSD-3-Clause
package strainwave.spy;

import java.awt.Window;
import java.awt.event.ActionEvent;
import java.awt.event.WindowAdapter;
import java.awt.event.WindowEvent;
import java.beans.PropertyVetoException;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import javax.swing.JInternalFrame;
import javax.swing.SwingUtilities;
import lcm.lcm.LCM;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;
import strainwave.state_v1;

/**
 * Offers "Plot joint" in the menu of a STATE channel; a double click does the same. The viewer finds this class by itself on
 * its class path, and gives each plot a window with a desktop of its own.
 */
public final class JointPlotPlugin implements SpyPlugin {
  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == state_v1.LCM_FINGERPRINT;
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new AbstractAction("Plot joint") {
      @Override
      public void actionPerformed(ActionEvent event) {
        open(desktop, channel.name);
      }
    };
  }

  private static void open(JDesktopPane desktop, String channel) {
    final JointPlot plot = new JointPlot(new JointFeed(LCM.getSingleton(), channel));
    final JInternalFrame frame = new JInternalFrame(channel, true, false, true);
    frame.add(plot);
    desktop.add(frame);
    frame.setVisible(true);
    final Window window = SwingUtilities.getWindowAncestor(desktop);
    window.setSize(plot.getPreferredSize());
    window.addWindowListener(new WindowAdapter() {
      @Override
      public void windowClosing(WindowEvent event) {
        plot.close();
      }
    });
    try {
      frame.setMaximum(true);
    } catch (PropertyVetoException refused) {
      frame.pack();
    }
  }
}
