# SPDX-License-Identifier: BSD-3-Clause
"""Orders over a fake network: what is sent, how often, and how answers are handled."""
import base64
import pathlib
import tempfile
import threading
import time
import unittest

from played_orders import YIELDED, PlayedOrders, published
from strainwave import Faulted, InvalidInput, Joint, Mode, NoAnswer, NotDone, Reason, Refused, Yielded
from strainwave.conversation import most_transmissions
from strainwave.network import now_s


class Orders(PlayedOrders):
    def test_that_nobody_answers_are_repeated_identically_and_then_given_up(self):
        self.publish_state()
        with self.assertRaisesRegex(NoAnswer, "no acknowledgement of release in 0.2 s, after 4 transmissions: no state for 0.2 s; is strainwaved running. Whether the command was carried out is not known"):
            self.impatient_elbow.release()
        self.assertEqual(len(self.network.published), 4)
        self.assertEqual(len(set(self.network.published)), 1)

    def test_are_repeated_while_the_daemon_still_obeys_them_whatever_the_timeout(self):
        for timeout_s in (0.2, 1.0, 1.5, 20.0, 600.0):
            self.assertLessEqual(3 * timeout_s / most_transmissions(100, timeout_s), 1.0, timeout_s)

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

    def test_that_came_too_late_are_not_given_anew(self):
        self.publish_state()

        def daemon(*entry):
            self.answer(published(*entry), 0, Reason.TOO_OLD)
            self.publish_state(challenge=23)

        self.network.daemon = daemon
        with self.assertRaisesRegex(Refused, "command is too old"):
            self.elbow.release()
        self.assertEqual(len(self.network.published), 1)

    def test_of_a_program_that_stood_still_quote_the_state_that_they_were_decided_on(self):
        # New states arrive between reading the state and sending. Meanwhile another client has held the joint.
        for order in (self.elbow.enable, self.elbow.clear_fault, lambda: self.elbow.move(0.5, speed_limit_rad_s=1.0, wait=False)):
            self.publish_state(Mode.FAULTED if order == self.elbow.clear_fault else Mode.OFF, challenge=22)
            conversation, deciding_state = self.elbow._conversation, self.elbow._conversation.deciding_state

            def stands_still():
                state = deciding_state()
                self.publish_state(challenge=23)
                return state

            conversation.deciding_state = stands_still
            self.network.daemon = lambda *entry: self.answer(published(*entry), 0, Reason.TOO_OLD)
            with self.assertRaises(Refused):
                order()
            del conversation.deciding_state
            self.assertEqual(published(*self.network.published[-1]).challenge, 22)

    def test_of_a_program_that_stood_still_before_it_read_the_state_are_not_sent(self):
        self.publish_state()
        conversation, wait_for_state = self.elbow._conversation, self.elbow._conversation.wait_for_state
        conversation.wait_for_state = lambda: (time.sleep(1.1), wait_for_state())
        with self.assertRaisesRegex(NotDone, "elbow: this program stood still for 1.1 s after the call, and the order was not sent"):
            self.elbow.release()
        self.assertEqual(self.network.published, [])

    def test_after_an_own_stop_quote_a_state_that_came_after_its_answer(self):
        self.publish_state(Mode.OFF)
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        self.elbow.disable()
        threading.Timer(0.05, self.publish_state, [Mode.OFF], {"challenge": 23}).start()
        self.elbow.release()
        self.assertEqual([order.challenge for order in self.orders()], [22, 23])

    def test_after_a_fault_quote_a_challenge_from_after_it(self):
        self.publish_state()
        self.publish_state(Mode.FAULTED, fault=7)
        threading.Timer(0.05, self.publish_state, [Mode.FAULTED], {"challenge": 23}).start()
        self.network.daemon = lambda *entry: (self.answer(published(*entry)), self.publish_state(Mode.OFF, fault=0))
        self.elbow.clear_fault()
        self.assertEqual([order.challenge for order in self.orders()], [23])

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
        with self.assertRaisesRegex(NoAnswer, "elbow: the stop was sent 8 times, and no answer came: no daemon on prefix SW"):
            self.impatient_elbow.disable()
        self.assertEqual([order.action for order in self.orders()], [2] * 8)

    def test_tell_a_daemon_that_does_not_answer_from_one_whose_states_have_stopped(self):
        self.publish_state()
        time.sleep(0.2)
        with self.assertRaisesRegex(NoAnswer, "the stop was sent 8 times, and no answer came: no state for 4.[0-9] s"):
            self.impatient_elbow.disable()
        ended = threading.Event()

        def publish():
            while not ended.wait(0.02):
                self.publish_state()

        publisher = threading.Thread(target=publish)
        publisher.start()
        try:
            for order in (self.impatient_elbow.disable, self.impatient_elbow.release):
                with self.assertRaisesRegex(NoAnswer, ": the daemon publishes its state but does not answer; see its log"):
                    order()
        finally:
            ended.set()
            publisher.join()
        with self.assertRaisesRegex(NoAnswer, "^elbow: its limits are not known: no state for [12].. s$"):
            self.impatient_elbow.limits

    def test_that_were_accepted_say_so_when_the_states_stop(self):
        def daemon(*entry):
            self.answer(published(*entry))
            self.publish_state(Mode.STARTING)

        self.publish_state(Mode.OFF)
        self.network.daemon = daemon
        with self.assertRaisesRegex(NoAnswer, "^elbow: the order was accepted, then no state for 0.2 s; the last mode was starting$"):
            self.impatient_elbow.enable()
        self.publish_state(Mode.HOLDING)
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        with self.assertRaisesRegex(NoAnswer, "lost contact with strainwaved during the motion: no state for 0.. s; the joint may still be moving$"):
            self.impatient_elbow.move(0.5)

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
        self.network.joints = {("SW", "wrist"): now_s(), ("LAB", "hip"): now_s()}
        with self.assertRaisesRegex(NoAnswer, "no joint 'elbow' on prefix SW; its joints are: wrist"):
            self.impatient_elbow.enable()
        # Another object of this program heard the joint earlier. Since this object exists, the joint has been silent.
        self.network.joints = {("SW", "elbow"): now_s() - 0.5}
        with self.assertRaisesRegex(NoAnswer, "^elbow: no state came in 0.2 s; the last one came 0.7. s ago"):
            self.impatient_elbow.enable()
        self.network.joints = {("SW", "elbow"): now_s() - 60.0, ("LAB", "foot"): now_s() - 60.0}
        with self.assertRaisesRegex(NoAnswer, "no daemon on prefix SW in 0.2 s .*Is strainwaved running"):
            self.impatient_elbow.enable()
        self.network.joints = {("LAB", "hip"): now_s()}
        with self.assertRaisesRegex(NoAnswer, "Daemons are heard on: LAB"):
            self.impatient_elbow.enable()
        self.assertEqual(self.network.published, [])

    def test_to_a_joint_whose_states_are_no_states_say_that_versions_differ(self):
        for handler in self.network._handlers[b"SW.elbow.STATE"]:
            handler()(b"something else")
        with self.assertRaisesRegex(NoAnswer, "the daemon on prefix SW has another version"):
            self.impatient_elbow.enable()

    def wait_for_move(self, elbow, *states):
        """Returns the result of a move to 0.5. The states follow in this order, and the last one repeats."""
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

    def test_to_move_a_little_are_not_said_to_have_taken_as_long_as_old_states_may_come(self):
        there = dict(mode=Mode.HOLDING, target_position_rad=0.5, joint_position_rad=0.4995)
        self.assertLess(self.wait_for_move(self.elbow, there).duration_s, 0.1)

    def test_to_move_that_end_elsewhere_say_so(self):
        moving = dict(mode=Mode.TRACKING, target_position_rad=0.5)
        for end, error, words in ((dict(mode=Mode.FAULTED, fault=14), Faulted, "14: following error"),
                                  (dict(mode=Mode.FAULTED, fault=5, drive_error=4 << 24 | 50000), Faulted,
                                   "5: implausible reading: the position jumped by 0.05 rad from one reading to the next"),
                                  (dict(mode=Mode.FAULTED, fault=5, drive_error=-1), Faulted, "5: implausible reading"),
                                  (dict(mode=Mode.OFF), NotDone, "the joint was disabled"),
                                  (dict(mode=Mode.TRACKING, target_position_rad=0.1), NotDone, "another command replaced"),
                                  (dict(mode=Mode.HOLDING, session_id=12), NotDone, "daemon was restarted")):
            with self.subTest(words), self.assertRaisesRegex(error, words):
                self.wait_for_move(self.elbow, moving, end)
            self.publish_state(session_id=11, fault=0)

    def test_to_move_that_a_load_ended_say_which_and_where_the_joint_holds(self):
        moving = dict(mode=Mode.TRACKING, target_position_rad=0.5)
        yields = dict(mode=Mode.TRACKING, target_position_rad=0.2871, joint_position_rad=0.29, **YIELDED)
        with self.assertRaises(Yielded) as caught:
            self.wait_for_move(self.elbow, moving, yields, dict(mode=Mode.HOLDING, joint_position_rad=0.2871))
        self.assertEqual(str(caught.exception), "elbow: did not arrive at 0.5 rad: it yielded to a load of 13.1 N.m (load_Nm allows 12) at "
                         "0.3011 rad; it holds at 0.2871 rad")
        self.assertEqual((caught.exception.joint, caught.exception.load_Nm, caught.exception.limit_Nm, caught.exception.position_rad),
                         ("elbow", -13.1042, 12.0, 0.3011))
        self.assertIsInstance(caught.exception, NotDone)

    def test_to_move_that_a_load_ended_in_a_fault_tell_that(self):
        moving = dict(mode=Mode.TRACKING, target_position_rad=0.5)
        with self.assertRaisesRegex(Faulted, "24: load too large"):
            self.wait_for_move(self.elbow, moving, dict(mode=Mode.TRACKING, target_position_rad=0.3, **YIELDED),
                               dict(mode=Mode.FAULTED, fault=24))

    def test_to_move_are_not_ended_by_a_load_of_before(self):
        before = dict(mode=Mode.TRACKING, target_position_rad=0.3, **YIELDED)
        moving = dict(mode=Mode.TRACKING, target_position_rad=0.5, notices=0)
        self.wait_for_move(self.elbow, before, moving, dict(mode=Mode.HOLDING, joint_position_rad=0.5))

    def test_to_move_that_hold_outside_of_the_tolerance_say_how_far(self):
        moving = dict(mode=Mode.TRACKING, target_position_rad=0.5)
        with self.assertRaisesRegex(NotDone, "holds 1.00e-01 rad away from 0.5 rad, outside of tolerance_rad 0.001"):
            self.wait_for_move(self.impatient_elbow, moving, dict(mode=Mode.HOLDING, joint_position_rad=0.4))

    def test_to_move_that_hold_outside_say_how_far_in_as_many_digits_as_show_it(self):
        moving = dict(mode=Mode.TRACKING, target_position_rad=0.5)
        with self.assertRaisesRegex(NotDone, "holds -1.0004e-03 rad away from 0.5 rad, outside of tolerance_rad 0.001$"):
            self.wait_for_move(self.impatient_elbow, moving, dict(mode=Mode.HOLDING, joint_position_rad=0.5010004))

    def test_that_make_no_sense_are_refused_before_anything_is_sent(self):
        for attempt, words in ((lambda: self.elbow.move(float("inf")), "^elbow: position_rad = inf"),
                               (lambda: self.elbow.move("0.5"), "position_rad = '0.5'"),
                               (lambda: self.elbow.move(True), "position_rad = True"),
                               (lambda: self.elbow.move(0, tolerance_rad=0), "tolerance_rad = 0"),
                               (lambda: Joint("el bow"), "name = 'el bow': 1 to 24 characters"),
                               (lambda: Joint("elbow", prefix=""), "prefix = ''"),
                               (lambda: Joint("elbow", timeout_s=0), "^elbow: timeout_s = 0: 0.1 to 3600 is allowed$"),
                               (lambda: Joint("elbow", timeout_s=0.09), "^elbow: timeout_s = 0.09: 0.1 to 3600 is allowed$"),
                               (lambda: self.elbow.move(10**400), "^elbow: position_rad = 1000"),
                               (lambda: self.elbow.move(10**5000), "^elbow: position_rad = <int>: a finite number"),
                               (lambda: self.elbow.states(duration_s=float("nan")), "^elbow: duration_s = nan: 0 or above is allowed"),
                               (lambda: Joint("elbow", key=5), "key = 5: the name of a file is allowed"),
                               (lambda: Joint("elbow", key=0), "key = 0: the name of a file is allowed"),
                               (lambda: Joint("elbow", key="a\0b"), "the key cannot be read: embedded null"),
                               (lambda: Joint(10**5000), "name = <int>: 1 to 24 characters")):
            with self.subTest(words), self.assertRaisesRegex(InvalidInput, words):
                attempt()
        self.assertEqual(self.network.published, [])

    def test_to_move_for_more_than_an_hour_are_refused_with_the_least_speed_that_is_allowed(self):
        self.publish_state(setpoint_position_rad=-0.5)
        self.network.daemon = lambda *entry: self.answer(published(*entry))
        with self.assertRaisesRegex(InvalidInput, "^elbow: speed_limit_rad_s = 1e-300: at least 0.000281 is allowed: the way of 1 rad takes 1e.300 s"):
            self.elbow.move(0.5, speed_limit_rad_s=1e-300, wait=False)
        self.assertEqual(self.network.published, [])
        self.elbow.move(0.5, speed_limit_rad_s=0.000281, wait=False)
        self.assertEqual(len(self.network.published), 1)

    def test_are_not_signed_with_a_key_that_is_none_or_that_others_can_read(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / "key"
        for line, words in (("ed25519 AAAA operator", "this is a public key: give the file without .pub"),
                            (f"ed25519-secret {base64.b64encode(bytes(32)).decode()} operator", "other users can reach this secret key")):
            path.write_text(line + "\n")
            path.chmod(0o644)
            with self.subTest(words), self.assertRaisesRegex(InvalidInput, words):
                Joint("elbow", key=path)


class ANetwork(unittest.TestCase):
    def test_of_no_name_is_refused(self):
        for wrong in ("", 5, ["udpm://"], {}, False, b"udpm://239.255.76.67:7667"):
            with self.subTest(wrong), self.assertRaisesRegex(InvalidInput, "lcm_url = .*: udpm://GROUP:PORT"):
                Joint("elbow", key="", lcm_url=wrong)


if __name__ == "__main__":
    unittest.main()
