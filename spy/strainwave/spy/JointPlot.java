// SPDX-License-Identifier: BSD-3-Clause
package strainwave.spy;

import info.monitorenter.gui.chart.Chart2D;
import info.monitorenter.gui.chart.IAxis;
import info.monitorenter.gui.chart.ITrace2D;
import info.monitorenter.gui.chart.rangepolicies.RangePolicyFixedViewport;
import info.monitorenter.gui.chart.traces.Trace2DLtd;
import info.monitorenter.util.Range;
import java.awt.BasicStroke;
import java.awt.BorderLayout;
import java.awt.Color;
import java.awt.Dimension;
import java.awt.Font;
import java.awt.GridLayout;
import java.util.Arrays;
import java.util.List;
import javax.swing.BorderFactory;
import javax.swing.JLabel;
import javax.swing.JPanel;
import javax.swing.Timer;
import strainwave.state_v1;

/** Position and setpoint, error, torque, temperature of one joint over the last half minute, one instant above the other. Swing's thread only. */
public final class JointPlot extends JPanel {
  private static final double WINDOW_S = 30.0;
  private static final int REDRAW_EVERY_MS = 50;
  /** More than the feed keeps in a window. */
  private static final int POINTS = 2000;
  private static final double RAD_TO_MRAD = 1e3;
  private static final Color BLUE = new Color(0x1f, 0x5f, 0xa8);
  /** The numbers of state_v1.mode; see docs/messages.md. */
  private static final String[] MODES = {
      "off", "starting", "holding", "tracking", "stopping", "faulted", "homing", "releasing"};

  private final JointFeed feed;
  private final JLabel line = new JLabel("no state received yet");
  private final JPanel charts = new JPanel(new GridLayout(0, 1));
  private final Timer timer = new Timer(REDRAW_EVERY_MS, event -> draw());
  /** Wide and pale: where the joint follows, its position lies upon it. */
  private final ITrace2D setpoint = trace("setpoint", new Color(0xf0, 0xa0, 0x90), 5.0f);
  private final ITrace2D position = trace("position", BLUE, 1.5f);
  private final ITrace2D error = trace("setpoint - position", BLUE, 1.5f);
  /** Wide and pale, as the setpoint: what was asked for below what the drive says. */
  private final ITrace2D commanded = trace("torque commanded", new Color(0xa8, 0xd0, 0xa0), 5.0f);
  private final ITrace2D applied = trace("torque applied", new Color(0x2a, 0x70, 0x2a), 1.5f);
  private final ITrace2D temperature = trace("temperature in use", new Color(0xb3, 0x6b, 0x00), 1.5f);
  private final ITrace2D[] traces = {setpoint, position, error, commanded, applied, temperature};
  private final Chart2D[] all;
  private double begin_s = Double.NaN;
  private long session;

  JointPlot(JointFeed feed) {
    super(new BorderLayout());
    this.feed = feed;
    all = new Chart2D[] {chart("rad", setpoint, position), chart("mrad", error), chart("N m", commanded, applied),
        chart("°C", temperature)};
    line.setFont(line.getFont().deriveFont(Font.BOLD));
    line.setBorder(BorderFactory.createEmptyBorder(4, 8, 4, 8));
    add(line, BorderLayout.NORTH);
    add(charts, BorderLayout.CENTER);
    setPreferredSize(new Dimension(720, 760));
    timer.start();
  }

  void close() {
    timer.stop();
    feed.close();
  }

  /** For tests: how many points are drawn of each curve. */
  public int[] drawnPoints() {
    return Arrays.stream(traces).mapToInt(ITrace2D::getSize).toArray();
  }

  /** For tests: where each chart's time axis begins, and where it ends, in pixels from the window's left edge. */
  public int[][] timeAxes_px() {
    return Arrays.stream(all)
        .map(chart -> new int[] {chart.getX() + chart.getXChartStart(), chart.getX() + chart.getXChartEnd()})
        .toArray(int[][]::new);
  }

  /** For tests: how each chart's value axis writes `value`. */
  public String[] labels(double value) {
    return Arrays.stream(all).map(chart -> chart.getAxisY().getFormatter().format(value)).toArray(String[]::new);
  }

  private static ITrace2D trace(String name, Color color, float width) {
    final ITrace2D trace = new Trace2DLtd(POINTS, name);
    trace.setColor(color);
    trace.setStroke(new BasicStroke(width));
    return trace;
  }

  private Chart2D chart(String unit, ITrace2D... traces) {
    final Chart2D chart = new Chart2D();
    chart.setUseAntialiasing(true);
    for (ITrace2D trace : traces) chart.addTrace(trace);
    title(chart.getAxisX(), "s");
    title(chart.getAxisY(), unit);
    chart.getAxisY().setFormatter(new Numbers.Labels());
    chart.getAxisY().setPaintGrid(true);
    final JPanel place = new JPanel(new BorderLayout());
    place.setBackground(chart.getBackground());
    place.add(chart);
    charts.add(place);
    return chart;
  }

  private static void title(IAxis<?> axis, String text) {
    axis.setAxisTitle(new IAxis.AxisTitle(text));
  }

  /** Labels of the other axes are of unlike widths: who has narrow ones is moved to the right. */
  private void align() {
    final int widest_px = Arrays.stream(all).mapToInt(Chart2D::getXChartStart).max().orElse(0);
    for (Chart2D chart : all) {
      final JPanel place = (JPanel) chart.getParent();
      final int missing_px = widest_px - chart.getXChartStart();
      if (place.getInsets().left != missing_px) place.setBorder(BorderFactory.createEmptyBorder(0, missing_px, 0, 0));
    }
  }

  private void draw() {
    align();
    final List<JointFeed.Sample> samples = feed.take();
    if (samples.isEmpty()) return;
    for (JointFeed.Sample sample : samples) draw(sample);
    final JointFeed.Sample last = samples.get(samples.size() - 1);
    final double now_s = last.received_s() - begin_s;
    for (Chart2D chart : all)
      chart.getAxisX().setRangePolicy(
          new RangePolicyFixedViewport(new Range(Math.max(0.0, now_s - WINDOW_S), Math.max(now_s, 1.0))));
    line.setText(describe(last));
  }

  private void draw(JointFeed.Sample sample) {
    final state_v1 state = sample.state();
    if (Double.isNaN(begin_s)) begin_s = sample.received_s();
    // Another session is another run of the daemon: its curves begin anew.
    if (session != state.session_id) {
      for (ITrace2D trace : traces) trace.removeAllPoints();
      begin_s = sample.received_s();
      session = state.session_id;
    }
    final double time_s = sample.received_s() - begin_s;
    put(setpoint, time_s, state.setpoint_position_rad);
    put(position, time_s, state.joint_position_rad);
    put(error, time_s, RAD_TO_MRAD * sample.error_rad());
    put(commanded, time_s, state.torque_commanded_Nm);
    put(applied, time_s, state.torque_applied_Nm);
    put(temperature, time_s, state.temperature_used_C);
  }

  /** A temperature may be unknown: what is no number is not drawn. */
  private static void put(ITrace2D trace, double time_s, double value) {
    if (Double.isFinite(value)) trace.addPoint(time_s, value);
  }

  private static String describe(JointFeed.Sample sample) {
    final state_v1 state = sample.state();
    final String mode = state.mode >= 0 && state.mode < MODES.length ? MODES[state.mode] : "mode " + state.mode;
    final String fault = state.fault == 0 ? "" : ", fault " + state.fault + " (docs/faults.md)";
    return String.format("%s%s   position %s rad   error %s rad   torque %s N m   %s", mode, fault,
        Numbers.text("%+.6f", state.joint_position_rad), Numbers.text("%+.1e", sample.error_rad()),
        Numbers.text("%+.3f", state.torque_applied_Nm),
        Double.isNaN(state.temperature_used_C) ? "no temperature"
                                               : Numbers.text("%.1f", state.temperature_used_C) + " °C");
  }
}
