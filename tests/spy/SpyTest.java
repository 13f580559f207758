// SPDX-License-Identifier: BSD-3-Clause
import java.awt.Component;
import java.awt.Container;
import java.awt.Point;
import java.awt.Rectangle;
import java.awt.Robot;
import java.awt.Toolkit;
import java.awt.Window;
import java.awt.event.InputEvent;
import java.io.File;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Supplier;
import javax.imageio.ImageIO;
import javax.swing.JMenuItem;
import javax.swing.JTable;
import javax.swing.SwingUtilities;
import strainwave.spy.JointPlot;
import strainwave.spy.Numbers;

/**
 * Starts the viewer as strainwave-spy does, in a real X server next to a running daemon, and uses it with mouse events. Our types
 * must decode every channel, and "Plot joint" must draw the moving joint, with all curves over one time axis.
 *
 * <p>SpyTest PICTURE.png
 */
final class SpyTest {
  private static final long PATIENCE_MS = 30_000;
  private static final Map<String, String> TYPES = new HashMap<>(Map.of(
      "SW.elbow.STATE", "strainwave.state_v1", "SW.elbow.TEMPERATURE", "strainwave.temperature_v1", "SW.TIMING",
      "strainwave.timing_v1"));

  public static void main(String[] arguments) throws Exception {
    expectText("+0.000", "%+.3f", -0.0);
    expectText("0.0", "%.1f", -0.04);
    expectText("-0.1", "%.1f", -0.06);
    expectText("+0.0e+00", "%+.1e", -0.0);
    expectText("-1.0e-09", "%+.1e", -1e-9);
    lcm.spy.Spy.main(new String[0]);
    final JTable table = await("the viewer's table", () -> find(JTable.class));
    for (Map.Entry<String, String> expected : TYPES.entrySet())
      await(expected.getKey() + " decoded as " + expected.getValue(), () -> row(table, expected) >= 0 ? table : null);

    final Robot robot = new Robot();
    robot.setAutoWaitForIdle(true);
    place(SwingUtilities.getWindowAncestor(table), 0, 0, 640, 780);
    final Map.Entry<String, String> state = Map.entry("SW.elbow.STATE", TYPES.get("SW.elbow.STATE"));
    // Rows and window move while channels appear, so a click may miss and is repeated.
    JMenuItem found = null;
    for (int attempt = 0; found == null && attempt < 10; ++attempt) {
      click(robot, centre(table, row(table, state)), InputEvent.BUTTON3_DOWN_MASK);
      found = seek(3_000, () -> menuItem("Plot joint"));
    }
    final JMenuItem item = seenOrEnd("\"Plot joint\" in the channel's menu", found);
    final Point at = item.getLocationOnScreen();
    click(robot, new Point(at.x + item.getWidth() / 2, at.y + item.getHeight() / 2), InputEvent.BUTTON1_DOWN_MASK);
    final JointPlot plot = await("the plot's window", () -> find(JointPlot.class));
    place(SwingUtilities.getWindowAncestor(plot), 645, 0, 780, 780);

    final String[] zeros = plot.labels(-1e-12);
    System.out.println("a little below zero is labelled " + Arrays.toString(zeros));
    if (!Arrays.stream(zeros).allMatch("0"::equals)) System.exit(1);
    await("200 points of every curve",
        () -> Arrays.stream(plot.drawnPoints()).allMatch(points -> points >= 200) ? plot : null);
    // Labels change with the motion, and the axes follow at the next redraw. So they are aligned at most looks, even on a busy machine.
    int aligned = 0;
    for (int look = 0; look < 40; ++look, Thread.sleep(100)) {
      final int[][][] axes = new int[1][][];
      SwingUtilities.invokeAndWait(() -> axes[0] = plot.timeAxes_px());
      if (axes[0].length == 4 && Arrays.stream(axes[0]).allMatch(axis -> Arrays.equals(axis, axes[0][0]))) ++aligned;
    }
    System.out.println("time axes aligned at " + aligned + " of 40 looks");
    if (aligned < 20) System.exit(1);
    // A double click shows the fields of a channel that has no plot.
    final int temperatureRow =
        row(table, Map.entry("SW.elbow.TEMPERATURE", TYPES.get("SW.elbow.TEMPERATURE")));
    robot.setAutoWaitForIdle(false);  // two clicks far apart in time are not a double click
    for (int i = 0; i < 2; ++i) click(robot, centre(table, temperatureRow), InputEvent.BUTTON1_DOWN_MASK);
    final Window fields = await("the window of decoded fields", () -> {
      final lcm.spy.ObjectPanel panel = find(lcm.spy.ObjectPanel.class);
      return panel == null ? null : SwingUtilities.getWindowAncestor(panel);
    });
    place(fields, 0, 300, 640, 480);
    // Records more of the motion for the picture.
    Thread.sleep(8_000);
    final Rectangle screen = new Rectangle(Toolkit.getDefaultToolkit().getScreenSize());
    ImageIO.write(robot.createScreenCapture(screen), "png", new File(arguments[0]));
    System.out.println("drawn points: " + Arrays.toString(plot.drawnPoints()));
    System.exit(0);
  }

  /** Calls `find` on Swing's thread until it returns something. Ends the test if it never does. */
  private static <T> T await(String what, Supplier<T> find) throws Exception {
    return seenOrEnd(what, seek(PATIENCE_MS, find));
  }

  /** Returns what `find` returns on Swing's thread within `patience_ms`, or null. */
  private static <T> T seek(long patience_ms, Supplier<T> find) throws Exception {
    final long deadline_ms = System.currentTimeMillis() + patience_ms;
    while (System.currentTimeMillis() < deadline_ms) {
      final List<T> found = new ArrayList<>();
      SwingUtilities.invokeAndWait(() -> found.add(find.get()));
      if (found.get(0) != null) return found.get(0);
      Thread.sleep(100);
    }
    return null;
  }

  private static void expectText(String expected, String format, double value) {
    final String text = Numbers.text(format, value);
    if (text.equals(expected)) return;
    System.err.println(value + " by " + format + " is " + text + ", not " + expected);
    System.exit(1);
  }

  private static <T> T seenOrEnd(String what, T found) {
    if (found == null) {
      System.err.println("not seen: " + what);
      System.exit(1);
    }
    System.out.println("seen: " + what);
    return found;
  }

  private static int row(JTable table, Map.Entry<String, String> channel) {
    for (int row = 0; row < table.getRowCount(); ++row) {
      final String name = String.valueOf(table.getValueAt(row, 0));
      final String type = String.valueOf(table.getValueAt(row, 1));
      if (name.equals(channel.getKey()) && channel.getValue().endsWith(type) && !type.isEmpty()) return row;
    }
    return -1;
  }

  private static Point centre(JTable table, int row) {
    final Rectangle cell = table.getCellRect(row, 0, false);
    final Point corner = table.getLocationOnScreen();
    return new Point(corner.x + cell.x + cell.width / 2, corner.y + cell.y + cell.height / 2);
  }

  private static void click(Robot robot, Point at, int button) {
    robot.mouseMove(at.x, at.y);
    robot.mousePress(button);
    robot.mouseRelease(button);
    robot.delay(30);
  }

  private static void place(Window window, int x, int y, int width, int height) throws Exception {
    SwingUtilities.invokeAndWait(() -> {
      window.setBounds(x, y, width, height);
      window.validate();
    });
    Thread.sleep(300);
  }

  private static <T extends Component> T find(Class<T> kind) {
    for (Window window : Window.getWindows()) {
      final T found = window.isShowing() ? find(kind, window) : null;
      if (found != null) return found;
    }
    return null;
  }

  private static <T extends Component> T find(Class<T> kind, Container inside) {
    for (Component component : inside.getComponents()) {
      if (kind.isInstance(component)) return kind.cast(component);
      final T deeper = component instanceof Container ? find(kind, (Container) component) : null;
      if (deeper != null) return deeper;
    }
    return null;
  }

  private static JMenuItem menuItem(String text) {
    final Object[] path = javax.swing.MenuSelectionManager.defaultManager().getSelectedPath();
    for (Object element : path) {
      if (!(element instanceof Container)) continue;
      for (Component component : ((Container) element).getComponents())
        if (component instanceof JMenuItem && ((JMenuItem) component).getText().equals(text) && component.isShowing())
          return (JMenuItem) component;
    }
    return null;
  }
}
