"""Orders over a network that the test plays: what is sent, how often, and what becomes of the answers."""
import threading
import unittest

from strainwave import (Action, Faulted, InvalidInput, Joint, Mode, NoAnswer, NotDone, Path, Reason, Refused, ack_v1, command_v1,
                        limits_v1, messages, path_v1, setpoint_v2, state_v1)
from strainwave.network import Network, parse_url

COMMAND, SETPOINT, PATH = "SW.elbow.COMMAND", "SW.elbow.SETPOINT", "SW.elbow.PATH"
TYPES = {COMMAND: command_v1, SETPOINT: setpoint_v2, PATH: path_v1}


class PlayedNetwork:
    """Of Network what a joint needs; `daemon` sees each message as it is published and may answer at once."""

    url = "udpm://played"
    listen, wait_until = Network.listen, Network.wait_until

    def __init__(self):
        self.changed = threading.Condition(threading.RLock())
        self.joints = set()
        self._handlers = {}
        self.published = []
        self.daemon = lambda channel, message: None

    def publish(self, channel, message):
        self.published.append((channel, message))
        self.daemon(channel, message)

    def deliver(self, kind, message):
        with self.changed:
            for handler in self._handlers[f"SW.elbow.{kind}".encode()]:
                handler()(message.encode())
            self.changed.notify_all()


def published(channel, message):
    return messages.decode_exactly(TYPES[channel], message)


class Orders(unittest.TestCase):
    def setUp(self):
        self.network = PlayedNetwork()
        shared = Network.shared
        self.addCleanup(setattr, Network, "shared", shared)
        Network.shared = lambda url=None: self.network
        self.elbow = Joint("elbow", key="", timeout_s=30)
        self.impatient_elbow = Joint("elbow", key="", timeout_s=0.2)
        self.state = messages.blank(state_v1)
        self.state.session_id, self.state.challenge = 11, 22

    def publish_state(self, mode=Mode.HOLDING, **fields):
        self.state.mode = int(mode)
        for name, value in fields.items():
            setattr(self.state, name, value)
        self.network.deliver("STATE", self.state)

    def answer(self, order, accepted=1, reason=Reason.ACCEPTED, text="", **fields):
        ack = messages.blank(ack_v1)
        ack.sender_id, ack.sequence, ack.accepted, ack.reason = order.sender_id, order.sequence, accepted, int(reason)
        ack.text = text.encode().ljust(232, b"\0")
        for name, value in fields.items():
            setattr(ack, name, value)
        self.network.deliver("ACK", ack)

    def orders(self):
        return [published(*entry) for entry in self.network.published]

    def test_that_nobody_answers_are_repeated_identically_and_then_given_up(self):
        self.publish_state()
        with self.assertRaisesRegex(NoAnswer, "no acknowledgement of release in 0.2 s, after 4 transmissions"):
            self.impatient_elbow.release()
        self.assertEqual(len(self.network.published), 4)
        self.assertEqual(len(set(self.network.published)), 1)

    def test_quote_session_and_challenge_of_the_latest_state(self):
        self.publish_state()
        self.publish_state(challenge=33)
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        self.elbow.release()
        order, = self.orders()
        self.assertEqual((order.session_id, order.challenge, order.action), (11, 33, 8))

    def test_behind_another_program_of_the_key_are_sent_above_it(self):
        self.publish_state()
        ahead = 1 << 61

        def daemon(*entry):
            order = published(*entry)
            if order.sequence <= ahead:
                self.answer(order, 0, Reason.OLD_SEQUENCE, last_sequence=ahead)
            else:
                self.answer(order)

        self.network.daemon = daemon
        self.elbow.release()
        self.assertEqual([order.sequence > ahead for order in self.orders()], [False, True])

    def test_that_came_too_late_are_given_anew_from_a_newer_state(self):
        self.publish_state()

        def daemon(*entry):
            order = published(*entry)
            if order.challenge == 22:
                self.answer(order, 0, Reason.TOO_OLD)
                self.publish_state(challenge=23)
            else:
                self.answer(order)

        self.network.daemon = daemon
        self.elbow.release()
        self.assertEqual([order.challenge for order in self.orders()], [22, 23])

    def test_that_a_stop_of_somebody_else_has_overtaken_are_not_given_anew(self):
        self.publish_state()

        def daemon(*entry):
            self.answer(published(*entry), 0, Reason.SUPERSEDED)
            self.publish_state(challenge=23)

        self.network.daemon = daemon
        with self.assertRaisesRegex(Refused, "superseded"):
            self.elbow.release()
        self.assertEqual(len(self.network.published), 1)

    def test_that_are_refused_say_why_by_name_and_are_not_repeated(self):
        self.publish_state()
        self.network.daemon = lambda *entry: self.answer(published(*entry), 0, Reason.OUT_OF_RANGE, "from \x1b[31m-1 to 1")
        with self.assertRaises(Refused) as caught:
            self.elbow.move(90)
        self.assertIs(caught.exception.reason, Reason.OUT_OF_RANGE)
        self.assertEqual(str(caught.exception), "elbow: move to 90 rad refused (3, out of range): from ?[31m-1 to 1; positions are in "
                         "rad: 90 degrees would be 1.5708")
        self.assertEqual(len(self.network.published), 1)

    def test_take_no_answer_to_others(self):
        self.publish_state()
        self.network.daemon = lambda *entry: self.answer(published(*entry), sender_id=1)
        with self.assertRaises(NoAnswer):
            self.impatient_elbow.release()

    def test_that_stop_wait_for_no_state_and_say_that_they_were_sent(self):
        with self.assertRaisesRegex(NoAnswer, "elbow: the stop was sent 4 times, and nothing answered: no daemon on prefix SW"):
            self.impatient_elbow.disable()
        self.assertEqual([order.action for order in self.orders()], [2] * 4)

    def test_to_enable_and_clear_are_not_sent_for_what_is_so_already(self):
        self.publish_state(Mode.TRACKING)
        self.elbow.enable()
        self.elbow.clear_fault()
        self.assertEqual(self.network.published, [])

    def test_to_enable_return_once_the_joint_holds(self):
        self.publish_state(Mode.OFF)

        def daemon(*entry):
            self.answer(published(*entry))
            self.publish_state(Mode.STARTING)
            threading.Timer(0.02, self.publish_state, [Mode.HOLDING]).start()

        self.network.daemon = daemon
        self.elbow.enable()
        self.assertEqual(self.elbow.state.mode, Mode.HOLDING)

    def test_to_a_joint_that_is_not_there_say_who_is(self):
        self.network.joints = {("SW", "wrist"), ("LAB", "hip")}
        with self.assertRaisesRegex(NoAnswer, "no joint 'elbow' on prefix SW; its joints are: wrist"):
            self.impatient_elbow.enable()
        self.network.joints = {("SW", "elbow")}  # its name is heard, and no state that is one
        with self.assertRaisesRegex(NoAnswer, "the daemon on prefix SW speaks another version"):
            self.impatient_elbow.enable()
        self.network.joints = {("LAB", "hip")}
        with self.assertRaisesRegex(NoAnswer, "Daemons are heard on: LAB"):
            self.impatient_elbow.enable()
        self.assertEqual(self.network.published, [])

    def wait_for_move(self, elbow, *states):
        """The result of a move to 0.5 after which these states follow each other; the last one again and again."""
        self.publish_state()
        done = threading.Event()

        def follow():
            for fields in states:
                self.publish_state(**fields)
                done.wait(0.02)
            while not done.wait(0.02):
                self.publish_state(**states[-1])

        follower = threading.Thread(target=follow)

        def daemon(*entry):
            self.answer(published(*entry))
            follower.start()

        self.network.daemon = daemon
        try:
            return elbow.move(0.5)
        finally:
            done.set()
            follower.join()

    def test_to_move_tell_how_long_it_took_and_how_far_it_is(self):
        there = dict(mode=Mode.HOLDING, target_position_rad=0.5, joint_position_rad=0.4995)
        arrival = self.wait_for_move(self.elbow, dict(mode=Mode.TRACKING, target_position_rad=0.5), there)
        self.assertAlmostEqual(arrival.error_rad, 0.0005)
        self.assertGreater(arrival.duration_s, 0)

    def test_to_move_that_end_elsewhere_say_so(self):
        moving = dict(mode=Mode.TRACKING, target_position_rad=0.5)
        for end, error, words in ((dict(mode=Mode.FAULTED, fault=14), Faulted, "14: following error"),
                                  (dict(mode=Mode.FAULTED, fault=5, drive_error=4 << 24 | 50000), Faulted,
                                   "5: implausible reading: the position jumped by 0.05 rad from one reading to the next"),
                                  (dict(mode=Mode.FAULTED, fault=5, drive_error=-1), Faulted, "5: implausible reading"),
                                  (dict(mode=Mode.OFF), NotDone, "the joint was disabled"),
                                  (dict(mode=Mode.TRACKING, target_position_rad=0.1), NotDone, "another order replaced"),
                                  (dict(mode=Mode.HOLDING, session_id=12), NotDone, "daemon was restarted")):
            with self.subTest(words), self.assertRaisesRegex(error, words):
                self.wait_for_move(self.elbow, moving, end)
            self.publish_state(session_id=11, fault=0)

    def test_to_move_that_hold_outside_of_the_tolerance_say_how_far(self):
        moving = dict(mode=Mode.TRACKING, target_position_rad=0.5)
        with self.assertRaisesRegex(NotDone, "holds 1.00e-01 rad away from 0.5 rad, outside of tolerance_rad 0.001"):
            self.wait_for_move(self.impatient_elbow, moving, dict(mode=Mode.HOLDING, joint_position_rad=0.4))

    def stream(self, **options):
        limits = messages.blank(limits_v1)
        limits.period_s, limits.position_min_rad, limits.position_max_rad = 0.001, -1.0, 1.0
        self.publish_state(Mode.TRACKING, cycle=1000)
        self.network.deliver("LIMITS", limits)
        return self.elbow.stream(**options)

    def test_of_a_stream_are_for_cycles_that_far_apart(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        stream = self.stream(ahead_s=0.9)
        for t in (5.0, 5.01, 5.0251):
            self.assertTrue(stream.put(t, 0.5, 2.0))
        first, second, third = self.orders()
        self.assertEqual((second.at_cycle - first.at_cycle, third.at_cycle - first.at_cycle), (10, 25))
        self.assertGreaterEqual(first.at_cycle, 1900)
        self.assertEqual([order.begins_stream for order in self.orders()], [1, 0, 0])
        self.assertEqual({(order.stream_id, order.derivatives, order.velocity_rad_s) for order in self.orders()},
                         {(first.stream_id, 1, 2.0)})

    def test_of_a_stream_that_are_late_are_left_out_and_counted(self):
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        stream = self.stream(valid_for_s=3.0)
        stream.put(0, 0.5)
        self.publish_state(Mode.TRACKING, cycle=3000)
        self.assertFalse(stream.put(1, 0.5))
        self.assertEqual((stream.late, len(self.network.published)), (1, 1))
        self.publish_state(Mode.TRACKING, cycle=9000)
        with self.assertRaisesRegex(NotDone, "the stream is over"):
            stream.put(4, 0.5)

    def test_of_a_stream_that_has_ended_raise_with_the_next_sample(self):
        for reason in (Reason.STREAM_ENDED, Reason.SUPERSEDED):
            with self.subTest(reason):
                def daemon(*entry):
                    order = published(*entry)
                    self.answer(order, order.begins_stream, reason if not order.begins_stream else Reason.ACCEPTED)

                self.network.published.clear()
                self.network.daemon = daemon
                stream = self.stream(ahead_s=0.9)
                stream.put(0, 0.1)
                stream.put(0.01, 0.1)
                with self.assertRaises(Refused) as caught:
                    stream.put(0.02, 0.1)
                self.assertIs(caught.exception.reason, reason)
                with self.assertRaisesRegex(NotDone, "this stream is over"):
                    stream.put(0.03, 0.1)
                self.assertEqual([order.begins_stream for order in self.orders()], [1, 0])

    def test_of_a_stream_after_its_close_are_refused_and_begin_nothing(self):
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
        """A stream whose second sample is refused; the joint holds when it is told to."""
        def daemon(channel, message):
            order = published(channel, message)
            refused = channel == SETPOINT and not order.begins_stream
            self.answer(order, not refused, reason if refused else Reason.ACCEPTED,
                        **({name: value(order) for name, value in answer.items()} if refused else {}))
            if channel == COMMAND:
                self.publish_state(Mode.HOLDING, cycle=3000)

        self.network.daemon = daemon
        return self.stream(ahead_s=0.9)

    def test_of_a_stream_that_a_later_one_overtook_are_counted_and_the_stream_goes_on(self):
        stream = self.stream_refused(Reason.OLD_SEQUENCE, last_sequence=lambda order: order.sequence)
        for t in (0, 0.01, 0.02):
            stream.put(t, 0.1)
        self.assertGreaterEqual(stream.late, 1)

    def test_of_a_stream_that_another_program_is_ahead_of_end_it(self):
        stream = self.stream_refused(Reason.OLD_SEQUENCE, last_sequence=lambda order: order.sequence + 5)
        stream.put(0, 0.1)
        stream.put(0.01, 0.1)
        with self.assertRaisesRegex(Refused, "sequence not rising"):
            stream.put(0.02, 0.1)

    def test_of_a_stream_that_are_refused_end_in_a_hold_and_leave_the_next_stream_alone(self):
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

    def test_of_a_stream_stop_with_what_its_program_raises(self):
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

    def test_that_make_no_sense_are_refused_before_anything_is_sent(self):
        stream = self.stream()
        for attempt, words in ((lambda: stream.put(0, 1.5), r"position_rad = 1.5: -1.0 to 1.0 is allowed"),
                               (lambda: stream.put(float("nan"), 0), "t = nan"), (lambda: stream.put(0, "there"), "position_rad = 'there'"),
                               (lambda: stream.put(0, 0, acceleration_rad_s2=1), "only with velocity_rad_s"),
                               (lambda: stream.put(0, 0, torque_Nm=float("inf")), "torque_Nm = inf"),
                               (lambda: stream.put(0, 0, load_inertia_kgm2=-1), "load_inertia_kgm2 = -1"),
                               (lambda: self.elbow.stream(ahead_s=1.5), "ahead_s = 1.5: above 0 to 0.9"),
                               (lambda: self.elbow.move(float("inf")), "position_rad = inf"),
                               (lambda: self.elbow.move(0, tolerance_rad=0), "tolerance_rad = 0"),
                               (lambda: Joint("el bow"), "name = 'el bow': 1 to 24 characters"),
                               (lambda: Joint("elbow", prefix=""), "prefix = ''"),
                               (lambda: Joint("elbow", timeout_s=0), "timeout_s = 0")):
            with self.subTest(words), self.assertRaisesRegex(InvalidInput, words):
                attempt()
        self.assertEqual(self.network.published, [])

    KNOTS = [(0, 0.25, 0), (0.5, 0.5, 0.75), (1, 0.75, 0)]

    def test_of_paths_are_loaded_and_then_started(self):
        self.publish_state()
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        path = Path({self.elbow: self.KNOTS})
        path.start()
        path.pause()
        path.resume()
        part, *commands = self.orders()
        self.assertNotEqual(part.path_id, 0)
        self.assertEqual((part.joint_count, part.knot_count), (1, 3))
        knots = list(zip(part.time_s, part.position_rad, part.velocity_rad_s))
        self.assertEqual(knots[:3], self.KNOTS)
        self.assertEqual([order.action for order in commands], [Action.RESUME, Action.PAUSE, Action.RESUME])

    def test_of_paths_that_are_refused_start_nothing(self):
        self.publish_state()
        self.network.daemon = lambda *entry: self.answer(published(*entry), 0, Reason.OUT_OF_RANGE, "elbow, knot 1")
        with self.assertRaisesRegex(Refused, "elbow: its part of the path refused .3, out of range.: elbow, knot 1"):
            Path({self.elbow: self.KNOTS}).start()
        self.assertEqual([channel for channel, _ in self.network.published], [PATH])

    def test_of_paths_with_more_knots_than_there_is_room_for_are_refused_before_anything_is_sent(self):
        Path({self.elbow: [(i, 0, 0) for i in range(320)]})
        for knots, words in (([(i, 0, 0) for i in range(321)], "321 knots: 2 to 320"), ([(0, 0, 0)], "1 knots"),
                             ([(0, 0), (1, 0, 0)], "knot 0"), ([(0, 0, 0), (1, "x", 0)], "knot 1 = 'x'"),
                             ([0, 0.25, 0], "knot 0 = 0: .time_s"), (None, "None: a list of knots")):
            with self.subTest(words), self.assertRaisesRegex(InvalidInput, words):
                Path({self.elbow: knots})
        for wrong, words in (({"elbow": self.KNOTS}, "'elbow': a Joint is allowed, as Joint\\('elbow'\\)"), (self.KNOTS, "{joint: ")):
            with self.subTest(words), self.assertRaisesRegex(InvalidInput, words):
                Path(wrong)


class Urls(unittest.TestCase):
    def test_are_read_as_lcm_does(self):
        self.assertEqual(parse_url("udpm://239.1.2.3:99?ttl=1"), ("239.1.2.3", 99, 1))
        self.assertEqual(parse_url("udpm://"), ("239.255.76.67", 7667, 0))

    def test_that_are_none_are_refused(self):
        for url in ("", "tcpq://1.2.3.4:5", "udpm://10.0.0.1:7667", "udpm://239.255.76.67:0", "udpm://239.255.76.67:99999",
                    "udpm://239.255.76.67:x", "udpm://host:7667", "udpm://239.255.76.67?ttl=x", 5):
            with self.assertRaisesRegex(InvalidInput, "lcm_url = "):
                parse_url(url)


if __name__ == "__main__":
    unittest.main()
