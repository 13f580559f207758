package strainwave.spy;

import java.awt.event.ActionEvent;
import java.awt.event.WindowAdapter;
import java.awt.event.WindowEvent;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import javax.swing.JFrame;
import lcm.lcm.LCM;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;
import strainwave.state_v1;

/** Offers "Plot joint" in the menu of a STATE channel. The viewer finds this class by itself on its class path. */
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
        open(channel.name);
      }
    };
  }

  private static void open(String channel) {
    final JointPlot plot = new JointPlot(new JointFeed(LCM.getSingleton(), channel));
    final JFrame frame = new JFrame(channel);
    frame.add(plot);
    frame.setDefaultCloseOperation(JFrame.DISPOSE_ON_CLOSE);
    frame.addWindowListener(new WindowAdapter() {
      @Override
      public void windowClosed(WindowEvent event) {
        plot.close();
      }
    });
    frame.pack();
    frame.setVisible(true);
  }
}
