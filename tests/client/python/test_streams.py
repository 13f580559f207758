# SPDX-License-Identifier: BSD-3-Clause
"""Streams over a fake network: the cycles of the samples, late samples, and the end of a stream."""
import math
import threading
import time
import unittest

from played_orders import COMMAND, SETPOINT, TYPES, YIELDED, PlayedOrders, published
from strainwave import Fault, Faulted, InvalidInput, Joint, Mode, NoAnswer, NotDone, Reason, Refused, StrainwaveError, Yielded, limits_v1, messages


class Streams(PlayedOrders):
    def setUp(self):
        super().setUp()
        self.limits = messages.blank(limits_v1)
        self.limits.period_s, self.limits.position_min_rad, self.limits.position_max_rad, self.limits.torque_limit_Nm = 0.001, -1.0, 1.0, 34.0

    def stream(self, **options):
        self.publish_state(Mode.TRACKING, cycle=1000)
        self.network.deliver("LIMITS", self.limits)
        return self.elbow.stream(**options)

    def test_that_fall_silent_before_their_end_say_since_when(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        stream = self.stream(ahead_s=0.1)
        stream.put(0, 0.1)
        self.elbow._conversation.timeout_s = 0.2
        with self.assertRaisesRegex(NoAnswer, "no state for [0-9.]+ s"):
            stream.close()

    def test_of_a_joint_that_fell_silent_tell_so_with_the_next_sample(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        stream = self.stream(ahead_s=0.1)
        stream.put(0, 0.1)
        self.elbow._conversation.timeout_s = 0.2
        stream.put(0.05, 0.1)
        with self.assertRaisesRegex(NoAnswer, "elbow: no state for [0-9.]+ s; is strainwaved running"):
            for k in range(50, 100):
                stream.put(0.01 * k, 0.1)
        self.assertLess(len(self.orders()), 5)

    def test_of_a_program_that_stood_still_itself_go_on_with_the_states_that_wait(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        stream = self.stream(ahead_s=0.1)
        stream.put(0, 0.1)
        self.elbow._conversation.received_s -= 40.0
        timer = threading.Timer(0.1, lambda: self.publish_state(Mode.TRACKING, cycle=1100))
        timer.start()
        stream.put(0.05, 0.1)
        timer.join()
        self.assertEqual(len(self.orders()), 2)

    def test_send_samples_for_cycles_that_far_apart(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        stream = self.stream(ahead_s=0.9)
        with self.assertRaisesRegex(NotDone, "elbow: the stream has not begun"):
            stream.cycle_of(5.0)
        for t in (5.0, 5.01, 5.0251):
            self.assertTrue(stream.put(t, 0.5, 2.0))
        first, second, third = self.orders()
        self.assertEqual([stream.cycle_of(t) for t in (5.0, 5.01, 5.0251)], [order.at_cycle for order in self.orders()])
        for t in (float("nan"), float("inf"), 1e300, "5"):
            with self.assertRaisesRegex(InvalidInput, "elbow: t = "):
                stream.cycle_of(t)
        self.assertEqual((second.at_cycle - first.at_cycle, third.at_cycle - first.at_cycle), (10, 25))
        self.assertGreaterEqual(first.at_cycle, 1900)
        self.assertEqual([order.begins_stream for order in self.orders()], [1, 0, 0])
        self.assertEqual({(order.stream_id, order.derivatives, order.velocity_rad_s) for order in self.orders()},
                         {(first.stream_id, 1, 2.0)})

    def test_whose_first_sample_nobody_answers_say_so_in_words(self):
        stream = self.stream()
        self.elbow._conversation.timeout_s = 0.2
        with self.assertRaisesRegex(NoAnswer, "no acknowledgement of the first setpoint of the stream, 0.5 rad, in 0.2 s"):
            stream.put(0, 0.5)

    def test_tell_when_each_sample_is_sent(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        stream = self.stream(ahead_s=0.9)
        spans = []
        for t in (5.0, 5.01, 5.02):
            before = time.time_ns() // 1000
            stream.put(t, 0.5)
            spans.append((before, time.time_ns() // 1000))
        for order, (before, after) in zip(self.orders(), spans, strict=True):
            self.assertTrue(before <= order.utime <= after, (before, order.utime, after))

    def test_leave_out_and_count_samples_that_are_late(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        stream = self.stream(valid_for_s=3.0)
        stream.put(0, 0.5)
        self.publish_state(Mode.TRACKING, cycle=3000)
        self.assertFalse(stream.put(1, 0.5))
        self.assertEqual((stream.late, len(self.network.published)), (1, 1))
        self.publish_state(Mode.TRACKING, cycle=9000)
        with self.assertRaisesRegex(NotDone, "stream timed out after 2 late samples"):
            stream.put(4, 0.5)

    def test_know_the_cycle_though_their_program_stood_still_and_hears_old_states_first(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        stream = self.stream(valid_for_s=10.0)
        stream.put(0, 0.5)
        # Five seconds later the client handles the states of the first second. They fill the memory of its clock.
        self.publish_state(Mode.TRACKING, cycle=6000)
        for i in range(100):
            self.state.cycle = 1000 + 5 * i
            self.network.deliver("STATE", self.state, age_s=5 - 0.005 * i)
        self.assertFalse(stream.put(1, 0.5))
        self.assertEqual((stream.late, len(self.network.published)), (1, 1))

    def test_quote_no_old_state_once_their_program_goes_on(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        stream = self.stream(ahead_s=0.9, valid_for_s=10.0)
        stream.put(0, 0.5)
        self.network.deliver("STATE", self.state, age_s=0.8)
        self.assertFalse(stream.put(0.3, 0.5))
        self.assertEqual(stream.late, 1)
        later = threading.Timer(0.05, self.publish_state, [Mode.TRACKING], {"challenge": 23})
        later.start()
        self.addCleanup(later.join)
        self.assertTrue(stream.put(1.2, 0.5))
        self.assertEqual(self.orders()[-1].challenge, 23)

    def test_that_have_ended_raise_with_the_next_sample(self):
        for reason in (Reason.STREAM_ENDED, Reason.SUPERSEDED, Reason.WRONG_SESSION):
            with self.subTest(reason):
                def daemon(*entry):
                    order = published(*entry)
                    self.answer(order, order.begins_stream, reason if not order.begins_stream else Reason.ACCEPTED)

                self.network.published.clear()
                self.network.daemon = daemon
                stream = self.stream(ahead_s=0.9)
                stream.put(0, 0.1)
                stream.put(0.01, 0.1)
                with self.assertRaisesRegex(Refused, "; this stream is over; Joint.stream.. opens a new one$") as caught:
                    stream.put(0.02, 0.1)
                self.assertIs(caught.exception.reason, reason)
                with self.assertRaisesRegex(NotDone, "this stream is over"):
                    stream.put(0.03, 0.1)
                self.assertEqual([order.begins_stream for order in self.orders()], [1, 0])

    def test_whose_samples_quoted_old_states_say_so_at_their_end(self):
        reasons = [Reason.ACCEPTED, Reason.TOO_OLD, Reason.CYCLE_IS_OVER, Reason.TOO_OLD, Reason.SUPERSEDED]
        self.network.daemon = lambda *entry: self.answer(published(*entry), int(reasons[0] == Reason.ACCEPTED), reasons.pop(0))
        stream = self.stream(ahead_s=0.9)
        with self.assertRaisesRegex(Refused, "; 1 of its samples came late, 2 quoted an old state; this stream is over; Joint.stream"):
            for k in range(6):
                stream.put(0.01 * k, 0.1)
        self.assertEqual((stream.late, stream.outdated), (1, 2))

    def test_in_milliseconds_say_so_and_do_not_wait_for_seconds(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        for step in (1.0, 10.0):  # 1 kHz and 100 Hz, in milliseconds
            stream = self.stream(ahead_s=0.1)
            stream.put(0, 0.1)
            begin = time.monotonic()
            with self.assertRaisesRegex(InvalidInput, f"^elbow: t = {step}: due in .* s, at most 0.5 is allowed: t counts seconds, not milliseconds"):
                stream.put(step, 0.1)
            self.assertLess(time.monotonic() - begin, step)

    def test_whose_velocities_contradict_hand_on_what_the_daemon_says_of_them(self):
        words = "the joint is tracking: velocity_rad_s is 57.3 times the rate at which position_rad changes, as if in deg/s"
        def daemon(*entry):
            order = published(*entry)
            self.answer(order, order.begins_stream, Reason.ACCEPTED if order.begins_stream else Reason.VELOCITIES_CONTRADICT,
                        text="" if order.begins_stream else words)

        self.network.daemon = daemon
        stream = self.stream(ahead_s=0.9)
        stream.put(0, 0.1, 57.3)
        stream.put(0.01, 0.11, 57.3)
        with self.assertRaisesRegex(Refused, words):
            stream.put(0.02, 0.12, 57.3)
        with self.assertRaisesRegex(NotDone, "this stream is over"):
            stream.put(0.03, 0.13)

    def stream_ended(self, reason, mode, **fields):
        """A stream whose second sample is refused before the states show the reason."""
        def daemon(channel, message):
            order = published(channel, message)
            if order.begins_stream:
                return self.answer(order)
            self.answer(order, 0, reason)
            for cycle in (1010, 1015):
                later = threading.Timer(0.01 * (cycle - 1005) / 5, self.publish_state, [mode], dict(cycle=cycle, **fields))
                later.start()
                self.addCleanup(later.join)

        self.network.daemon = daemon
        stream = self.stream(ahead_s=0.9)
        stream.put(0, 0.1)
        stream.put(0.01, 0.1)
        return stream

    def test_that_a_restart_of_the_daemon_ended_say_so_and_what_to_do(self):
        words = ("^elbow: did not follow the stream to its end: the daemon was restarted, and the joint is off; enable it; "
                 "Joint.stream.. opens a new stream$")
        for reason in (Reason.WRONG_SESSION, Reason.STREAM_ENDED):
            def daemon(channel, message):
                order = published(channel, message)
                self.answer(order, order.begins_stream, reason if not order.begins_stream else Reason.ACCEPTED)
                if not order.begins_stream:
                    later = threading.Timer(0.02, self.publish_state, [Mode.OFF], dict(session_id=12))
                    later.start()
                    self.addCleanup(later.join)

            self.state.session_id = 11
            self.network.published.clear()
            self.network.daemon = daemon
            with self.subTest(reason):
                with self.assertRaisesRegex(NotDone, words), self.stream(ahead_s=0.9) as stream:
                    for t in (0, 0.01, 0.02):
                        stream.put(t, 0.1)
                with self.assertRaisesRegex(NotDone, "this stream is over"):
                    stream.put(0.03, 0.1)
                self.assertEqual([channel for channel, _ in self.network.published], [SETPOINT] * 2, "the joint is off: there is nothing to hold")

    def test_wait_for_no_cycle_that_a_restarted_daemon_is_far_from(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        for end in (lambda stream: stream.put(0.01, 0.1), lambda stream: stream.close()):
            self.state.session_id = 11
            stream = self.stream(ahead_s=0.9)
            stream.put(0, 0.1)
            later = threading.Timer(0.05, self.publish_state, [Mode.OFF], dict(session_id=12, cycle=0))
            self.publish_state(Mode.TRACKING, cycle=1001)
            later.start()
            self.addCleanup(later.join)
            self.network.deliver("LIMITS", self.limits)
            begin = time.monotonic()
            with self.assertRaisesRegex(NotDone, "the daemon was restarted"):
                end(stream)
                stream.put(0.5, 0.1)
            self.assertLess(time.monotonic() - begin, 20)

    def test_that_a_fault_ended_raise_it_and_are_over(self):
        stream = self.stream_ended(Reason.FAULTED, Mode.FAULTED, fault=14)
        with self.assertRaises(Faulted) as caught, stream:
            stream.put(0.02, 0.1)
        self.assertIs(caught.exception.fault, Fault.FOLLOWING_ERROR)
        with self.assertRaisesRegex(NotDone, "this stream is over"):
            stream.put(0.03, 0.1)
        self.assertEqual([channel for channel, _ in self.network.published], [SETPOINT] * 2, "its drive is off: there is nothing to hold")

    def test_that_a_fault_ended_raise_it_though_no_refusal_came(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        for end in (lambda stream: stream.put(0.01, 0.1), lambda stream: stream.close()):
            stream = self.stream(ahead_s=0.9)
            stream.put(0, 0.1)
            self.publish_state(Mode.FAULTED, cycle=3000, fault=14)
            with self.assertRaises(Faulted):
                end(stream)

    def test_that_a_fault_ended_that_somebody_has_cleared_say_what_was_refused(self):
        stream = self.stream_ended(Reason.FAULTED, Mode.OFF)
        with self.assertRaises(Refused) as caught:
            stream.put(0.02, 0.1)
        self.assertIs(caught.exception.reason, Reason.FAULTED)

    def test_that_a_load_ended_say_which_and_are_over(self):
        stream = self.stream_ended(Reason.STREAM_ENDED, Mode.TRACKING, **YIELDED)
        with self.assertRaises(Yielded) as caught, stream:
            stream.put(0.02, 0.1)
        self.assertEqual(str(caught.exception), "elbow: did not follow the stream to its end: it yielded to a load of 13.1 N.m (load_Nm allows 12) "
                         "at 0.3011 rad; it is tracking")
        with self.assertRaisesRegex(NotDone, "this stream is over"):
            stream.put(0.03, 0.1)
        self.assertEqual([channel for channel, _ in self.network.published], [SETPOINT] * 2)

    def test_are_not_ended_by_a_load_of_before(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        for name, value in YIELDED.items():
            setattr(self.state, name, value)
        stream = self.stream(ahead_s=0.9)
        stream.put(0, 0.1)
        self.assertTrue(stream.put(0.01, 0.1))
        self.publish_state(Mode.TRACKING, cycle=2500)
        with self.assertRaises(Yielded):
            stream.put(1.7, 0.1)

    def test_refuse_samples_after_their_close_and_begin_nothing(self):
        def daemon(channel, message):
            self.answer(published(channel, message))
            self.publish_state(Mode.HOLDING, cycle=3000)

        self.network.daemon = daemon
        with self.stream(ahead_s=0.9) as stream:
            stream.put(0, 0.1)
        sent = len(self.network.published)
        with self.assertRaisesRegex(NotDone, "this stream is over"):
            stream.put(0.5, 0.1)
        self.assertEqual(len(self.network.published), sent)

    def stream_refused(self, reason, **answer):
        """A stream whose second sample is refused. The joint obeys a hold."""
        def daemon(channel, message):
            order = published(channel, message)
            refused = channel == SETPOINT and not order.begins_stream
            self.answer(order, not refused, reason if refused else Reason.ACCEPTED,
                        **({name: value(order) for name, value in answer.items()} if refused else {}))
            if channel == COMMAND:
                self.publish_state(Mode.HOLDING, cycle=3000)

        self.network.daemon = daemon
        return self.stream(ahead_s=0.9)

    def test_count_samples_that_a_later_one_overtook_and_go_on(self):
        stream = self.stream_refused(Reason.OLD_SEQUENCE, last_sequence=lambda order: order.sequence)
        for t in (0, 0.01, 0.02):
            stream.put(t, 0.1)
        self.assertGreaterEqual(stream.late, 1)

    def test_end_when_another_program_is_ahead(self):
        stream = self.stream_refused(Reason.OLD_SEQUENCE, last_sequence=lambda order: order.sequence + 5)
        stream.put(0, 0.1)
        stream.put(0.01, 0.1)
        with self.assertRaisesRegex(Refused, "sequence not rising"):
            stream.put(0.02, 0.1)

    def test_whose_samples_are_refused_end_in_a_hold_and_leave_the_next_stream_alone(self):
        with self.assertRaises(Refused), self.stream_refused(Reason.OUT_OF_RANGE) as stream:
            for t in (0, 0.01, 0.02):
                stream.put(t, 0.1)
        self.assertEqual(self.network.published[-1][0], COMMAND)
        late_refusal = next(order for order in self.orders() if order.sequence and not getattr(order, "begins_stream", 1))
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        stream = self.stream(ahead_s=0.9)
        stream.put(0, 0.1)
        self.answer(late_refusal, False, Reason.OUT_OF_RANGE)
        self.assertTrue(stream.put(0.01, 0.1))
        self.assertTrue(stream.put(0.02, 0.1))

    def test_stop_with_what_their_program_raises(self):
        def daemon(channel, message):
            order = published(channel, message)
            self.answer(order)
            if channel == COMMAND:
                self.publish_state(Mode.HOLDING)

        self.network.daemon = daemon
        with self.assertRaises(ZeroDivisionError), self.stream() as stream:
            stream.put(0, 0.1)
            stream.put(0.01, 1 / 0)
        self.assertEqual([channel for channel, _ in self.network.published], [SETPOINT, COMMAND])
        self.assertEqual(self.orders()[-1].action, 3)

    def test_are_beside_none_of_another_daemon_which_counts_its_own_cycles(self):
        first = self.stream()
        wrist = Joint("wrist", key="", prefix="B")
        self.network.deliver("STATE", self.state, "wrist", prefix="B")
        self.network.deliver("LIMITS", self.limits, "wrist", prefix="B")
        with self.assertRaisesRegex(InvalidInput, "^wrist has prefix B, elbow has SW: streams beside each other must belong to one daemon$"):
            wrist.stream(beside=first)

    def test_refuse_samples_that_make_no_sense_before_anything_is_sent(self):
        stream = self.stream()
        for attempt, words in ((lambda: stream.put(0, 1.5), "^elbow: position_rad = 1.5: from -1.0 to 1.0 is allowed .joint.limits.position_min_rad and position_max_rad of elbow.$"),
                               (lambda: stream.put(0, 90), "^elbow: position_rad = 90: .*; positions are in rad: 90 degrees would be 1.5708$"),
                               (lambda: stream.put(0, math.inf), "^elbow: position_rad = inf: .* of elbow.$"),
                               (lambda: stream.put(float("nan"), 0), "^elbow: t = nan"), (lambda: stream.put(0, "there"), "position_rad = 'there'"),
                               (lambda: stream.put(0, 0, acceleration_rad_s2=1), "^elbow: .*only with velocity_rad_s"),
                               (lambda: stream.put(0, 0, torque_Nm=float("inf")), "torque_Nm = inf"),
                               (lambda: stream.put(0, 0, torque_Nm=-99), "elbow: torque_Nm = -99: from -34.0 to 34.0 is allowed .joint.limits.torque_limit_Nm of elbow.$"),
                               (lambda: stream.put(0, 0, load_inertia_kgm2=-1), "load_inertia_kgm2 = -1"),
                               (lambda: self.elbow.stream(beside=self.elbow), "^elbow: beside = <.*>: a Stream is allowed"),
                               (lambda: self.elbow.stream(beside=0), "^elbow: beside = 0: a Stream is allowed"),
                               (lambda: self.elbow.stream(ahead_s=1.5), "^elbow: ahead_s = 1.5: above 0 to 0.9")):
            with self.subTest(words), self.assertRaisesRegex(InvalidInput, words):
                attempt()
        self.assertEqual(self.network.published, [])


class AHostileDaemon(PlayedOrders):
    """States and limits with arbitrary numbers. Orders to the joint must raise only the package's own errors."""

    NUMBERS = (0.0, -1.0, 5e-324, 1e308, math.nan)
    CYCLES = (0, 2**62, 2**63 - 1, -(2**63))

    def try_everything(self):
        try:
            with self.hurried_elbow.stream() as stream:
                stream.put(0.0, 0.0)
                stream.put(0.001, 0.0)
        except StrainwaveError:
            pass
        for order in (self.hurried_elbow.release, lambda: self.hurried_elbow.move(0.1, speed_limit_rad_s=0.5), lambda: self.hurried_elbow.limits):
            try:
                order()
            except StrainwaveError:
                pass

    def test_lets_no_error_out_that_is_not_ours(self):
        self.network.daemon = lambda channel, message: self.answer(published(channel, message)) if channel in TYPES else None
        self.hurried_elbow = Joint("elbow", key="", timeout_s=0.1)
        for number in self.NUMBERS:
            for cycle in self.CYCLES:
                limits = messages.blank(limits_v1)
                limits.session_id, limits.period_s = self.state.session_id, number
                limits.position_min_rad, limits.position_max_rad, limits.torque_limit_Nm = -3.0, 3.0, number
                self.publish_state(cycle=cycle, utime=cycle)
                self.network.deliver("LIMITS", limits)
                limits.period_s = 1e-6
                self.network.deliver("LIMITS", limits)
                self.try_everything()

    def test_does_not_make_a_time_of_the_program_too_large_for_a_message(self):
        self.network.daemon = lambda channel, message: self.answer(published(channel, message))
        limits = messages.blank(limits_v1)
        limits.session_id, limits.period_s, limits.position_min_rad, limits.position_max_rad = self.state.session_id, 1e-6, -3.0, 3.0
        self.publish_state(cycle=2**62)
        self.network.deliver("LIMITS", limits)
        stream = self.elbow.stream()
        with self.assertRaisesRegex(InvalidInput, "t = 1e.300: a finite time in s, from -1e.12 to 1e.12"):
            stream.put(1e300, 0.0)


if __name__ == "__main__":
    unittest.main()
