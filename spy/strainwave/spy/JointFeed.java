// SPDX-License-Identifier: BSD-3-Clause
package strainwave.spy;

import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMSubscriber;
import strainwave.state_v1;

/** Receives one joint's states on LCM's thread and keeps, until they are taken, those worth drawing. */
final class JointFeed implements LCMSubscriber {
  /** A state and when it came, in seconds of this machine's monotonic clock. */
  record Sample(double received_s, state_v1 state, double period_s) {
    /** At the instant when the position was measured: one period before this state's setpoint. */
    double error_rad() {
      return state.setpoint_position_rad - period_s * state.setpoint_velocity_rad_s - state.joint_position_rad;
    }
  }

  /** Of the states within so long the one with the largest error is kept: no peak is lost, and drawing stays cheap. */
  private static final double KEEP_ONE_WITHIN_S = 0.025;
  /** States that nobody takes (the window is hidden) are given up, the oldest first. */
  private static final int MOST_SAMPLES = 4000;

  private final LCM lcm;
  private final String channel;
  private final List<Sample> samples = new ArrayList<>();
  private double slotEnds_s = Double.NEGATIVE_INFINITY;
  /** The first state of the session, to know the loop's period by. */
  private state_v1 first;

  JointFeed(LCM lcm, String channel) {
    this.lcm = lcm;
    this.channel = channel;
    lcm.subscribe(channel, this);
  }

  void close() {
    lcm.unsubscribe(channel, this);
  }

  @Override
  public void messageReceived(LCM from, String onChannel, LCMDataInputStream in) {
    final double now_s = System.nanoTime() * 1e-9;
    try {
      final state_v1 state = new state_v1(in);
      add(new Sample(now_s, state, period_s(state)));
    } catch (IOException malformed) {
      // Not a state: the viewer's own table counts it as undecodable.
    }
  }

  private double period_s(state_v1 state) {
    if (first == null || first.session_id != state.session_id) first = state;
    final double cycles = (double) state.cycle - first.cycle;
    final double duration_s = 1e-6 * ((double) state.utime - first.utime);
    return cycles > 0 && duration_s > 0 ? duration_s / cycles : 0.0;
  }

  synchronized void add(Sample sample) {
    final int last = samples.size() - 1;
    if (last >= 0 && sample.received_s < slotEnds_s) {
      if (Math.abs(sample.error_rad()) > Math.abs(samples.get(last).error_rad())) samples.set(last, sample);
      return;
    }
    slotEnds_s = sample.received_s + KEEP_ONE_WITHIN_S;
    samples.add(sample);
    if (samples.size() > MOST_SAMPLES) samples.remove(0);
  }

  /** What came since the last call, the oldest first. */
  synchronized List<Sample> take() {
    final List<Sample> taken = new ArrayList<>(samples);
    samples.clear();
    return taken;
  }
}
