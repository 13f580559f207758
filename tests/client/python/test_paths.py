# SPDX-License-Identifier: BSD-3-Clause
"""Paths over a fake network."""
import math
import threading
import time
import unittest

from played_orders import PATH, YIELDED, PlayedOrders, published
from strainwave import Action, Faulted, InvalidInput, Joint, Mode, NotDone, Notice, Path, Reason, Refused, Yielded


class Paths(PlayedOrders):
    KNOTS = [(0, 0.25, 0), (0.5, 0.5, 0.75), (1, 0.75, 0)]

    def test_are_loaded_and_then_started(self):
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

    def test_of_anything_else_are_refused_with_what_is_allowed(self):
        for knots, words in ((None, "None: {joint: "), ({}, "at least one joint"), ({"elbow": self.KNOTS}, "as Joint.'elbow'."),
                             ({self.elbow: self.KNOTS, Joint("elbow", key=""): self.KNOTS}, "elbow: 2 Joints of that name have knots"),
                             ({self.elbow: self.KNOTS, Joint("elbow", key="", prefix="LEFT"): self.KNOTS}, "^elbow has prefix LEFT, elbow has SW: "),
                             ({self.elbow: self.KNOTS, Joint("wrist", key="", prefix="LEFT"): self.KNOTS}, "^wrist has prefix LEFT, elbow has SW: the joints of a path must belong to one daemon$")):
            with self.subTest(words), self.assertRaisesRegex(InvalidInput, words):
                Path(knots)

    def test_are_sent_again_as_often_as_a_network_may_lose_one_of_their_packets(self):
        self.publish_state()
        lost = 8

        def daemon(channel, message):
            if len(self.network.published) > lost:
                self.answer(published(channel, message))

        self.network.daemon = daemon
        Path({self.impatient_elbow: self.KNOTS}).start()
        self.assertEqual([channel for channel, _ in self.network.published], [PATH] * (lost + 1) + ["SW.elbow.COMMAND"])

    def test_that_are_refused_start_nothing(self):
        self.publish_state()
        self.network.daemon = lambda *entry: self.answer(published(*entry), 0, Reason.OUT_OF_RANGE, "elbow, knot 1")
        with self.assertRaisesRegex(Refused, "elbow: its part of the path refused .3, out of range.: elbow, knot 1"):
            Path({self.elbow: self.KNOTS}).start()
        self.assertEqual([channel for channel, _ in self.network.published], [PATH])

    def test_that_are_refused_and_look_like_degrees_say_so(self):
        self.publish_state()
        self.network.daemon = lambda *entry: self.answer(published(*entry), 0, Reason.OUT_OF_RANGE)
        with self.assertRaisesRegex(Refused, "positions are in rad: -90 degrees would be -1.5708"):
            Path({self.elbow: [(0, 0, 0), (0.5, -90, 0), (1, 45, 0)]}).start()
        self.network.daemon = lambda *entry: self.answer(published(*entry), 0, Reason.WRONG_MODE)
        with self.assertRaisesRegex(Refused, "not possible in this mode.$"):
            Path({self.elbow: [(0, 0, 0), (0.5, -90, 0), (1, 45, 0)]}).start()

    def test_that_nobody_started_say_so_when_they_are_waited_for(self):
        self.publish_state(target_position_rad=0.1)
        with self.assertRaisesRegex(NotDone, "elbow: is not on its way to 0.75 rad: this path is not under way; start.. begins it"):
            Path({self.elbow: self.KNOTS}).wait()

    def test_that_nobody_started_say_so_though_the_joint_stands_at_their_end(self):
        self.publish_state(target_position_rad=0.75, joint_position_rad=0.75, path_time_s=math.nan)
        with self.assertRaisesRegex(NotDone, "elbow: is not on its way to 0.75 rad: this path is not under way; start.. begins it"):
            Path({self.elbow: self.KNOTS}).wait()

    def test_that_another_program_has_just_started_are_waited_for_though_old_states_come_first(self):
        self.publish_state(target_position_rad=0.75, joint_position_rad=0.75, path_time_s=math.nan)
        later = threading.Timer(0.05, self.publish_state, [Mode.TRACKING], dict(path_time_s=0.1))
        later.start()
        self.addCleanup(later.join)
        with self.assertRaisesRegex(NotDone, "did not arrive in 0.5 s: it is at 0.100 s of 1.000 s"):
            Path({self.elbow: self.KNOTS}).wait(timeout_s=0.5)

    def test_tell_of_the_joint_that_faulted_and_not_of_those_that_it_stopped(self):
        wrist = Joint("wrist", key="", timeout_s=30)
        path = Path({self.elbow: self.KNOTS, wrist: self.KNOTS})
        self.publish_state(Mode.TRACKING, target_position_rad=0.75)
        self.publish_state(Mode.TRACKING, joint="wrist")

        def fault():
            self.publish_state(Mode.FAULTED, joint="wrist", fault=13)
            self.publish_state(Mode.HOLDING, fault=0, target_position_rad=0.3)

        later = threading.Timer(0.05, fault)
        later.start()
        self.addCleanup(later.join)
        with self.assertRaisesRegex(Faulted, "wrist.*13"):
            path.wait()

    def test_tell_of_the_joint_that_yielded_and_not_of_those_that_it_stopped(self):
        wrist = Joint("wrist", key="", timeout_s=30)
        path = Path({self.elbow: self.KNOTS, wrist: self.KNOTS})
        self.publish_state(Mode.TRACKING, target_position_rad=0.75)
        self.publish_state(Mode.TRACKING, joint="wrist")

        def give_way():
            self.publish_state(Mode.TRACKING, cycle=5, target_position_rad=0.3)
            time.sleep(0.005)
            self.publish_state(Mode.HOLDING, joint="wrist", joint_position_rad=0.2871, **YIELDED)
            self.publish_state(Mode.HOLDING, notices=0)

        later = threading.Timer(0.05, give_way)
        later.start()
        self.addCleanup(later.join)
        with self.assertRaisesRegex(Yielded, "^wrist: did not arrive at 0.75 rad: it yielded to a load of 13.1 N.m"):
            path.wait()

    def test_tell_of_each_joint_that_was_stopped_a_fault_first(self):
        wrist = Joint("wrist", key="", timeout_s=30)
        path = Path({self.elbow: self.KNOTS, wrist: self.KNOTS})
        for ends, words, kind in ((dict(mode=Mode.HOLDING), r"^elbow: did not arrive at 0.75 rad: it yielded .*\nwrist: did not arrive .*: it yielded", Yielded),
                                  (dict(mode=Mode.FAULTED, fault=24), r"^wrist: faulted .24: .*; once the cause is gone: Joint.clear_fault..\nelbow: did not arrive", Faulted)):
            self.publish_state(Mode.TRACKING, target_position_rad=0.75, notices=0, fault=0, cycle=1)
            self.publish_state(Mode.TRACKING, joint="wrist")

            def give_way():
                self.publish_state(Mode.HOLDING, cycle=5, target_position_rad=0.3, **YIELDED)
                self.publish_state(Mode.HOLDING, joint="wrist", notices=0)
                time.sleep(0.02)
                self.publish_state(joint="wrist", **(YIELDED | ends))

            later = threading.Timer(0.05, give_way)
            later.start()
            self.addCleanup(later.join)
            with self.subTest(kind), self.assertRaisesRegex(kind, words) as caught:
                path.wait()
            self.assertEqual({error.joint for error in caught.exception.each}, {"elbow", "wrist"})
            self.assertEqual(caught.exception.each[0].each, ())

    def test_return_when_all_joints_are_there(self):
        wrist = Joint("wrist", key="", timeout_s=30)
        for joint in ("elbow", "wrist"):
            self.publish_state(Mode.HOLDING, joint=joint, target_position_rad=0.75, joint_position_rad=0.7499)
        done = threading.Event()

        def publish():
            while not done.wait(0.02):
                for joint in ("elbow", "wrist"):
                    self.publish_state(Mode.HOLDING, joint=joint)

        publisher = threading.Thread(target=publish)
        publisher.start()
        try:
            arrivals = Path({self.elbow: self.KNOTS, wrist: self.KNOTS}).wait()
        finally:
            done.set()
            publisher.join()
        self.assertEqual(list(arrivals), [self.elbow, wrist])
        self.assertAlmostEqual(arrivals[wrist].error_rad, 0.0001)

    def test_that_somebody_paused_say_so_when_the_wait_has_lasted_long_enough(self):
        self.publish_state(Mode.TRACKING, target_position_rad=0.75, path_time_s=0.32, notices=int(Notice.PATH_PAUSED))
        with self.assertRaisesRegex(NotDone, "elbow: the path did not arrive in 0.05 s: it is paused at 0.320 s of 1.000 s"):
            Path({self.elbow: self.KNOTS}).wait(timeout_s=0.05)
        self.publish_state(Mode.TRACKING, notices=0)
        with self.assertRaisesRegex(NotDone, "in 0.05 s: it is at 0.320 s of 1.000 s"):
            Path({self.elbow: self.KNOTS}).wait(timeout_s=0.05)
        for wrong in (0, -1, "1", float("inf")):
            with self.subTest(wrong), self.assertRaisesRegex(InvalidInput, "timeout_s = .*: None or a number above 0 is allowed"):
                Path({self.elbow: self.KNOTS}).wait(timeout_s=wrong)

    def test_with_more_knots_than_there_is_room_for_are_refused_before_anything_is_sent(self):
        Path({self.elbow: [(i, 0, 0) for i in range(320)]})
        for knots, words in (([(i, 0, 0) for i in range(321)], "321 knots: 2 to 320"), ([(0, 0, 0)], "1 knot:"),
                             ([(0, 0), (1, 0, 0)], "knot 0"), ([(0, 0, 0), (1, "x", 0)], "knot 1: position_rad = 'x'"),
                             ([(0, 0, 0), (float("nan"), 0, 0)], "elbow: knot 1: time_s = nan: a finite"),
                             ([(0, 0, 0), (1, 0, 10**400)], "elbow: knot 1: velocity_rad_s = 1"),
                             ([0, 0.25, 0], "knot 0 = 0: .time_s"), (None, "None: a list of knots")):
            with self.subTest(words), self.assertRaisesRegex(InvalidInput, words):
                Path({self.elbow: knots})
        for wrong, words in (({"elbow": self.KNOTS}, "'elbow': a Joint is allowed, as Joint\\('elbow'\\)"), (self.KNOTS, "{joint: ")):
            with self.subTest(words), self.assertRaisesRegex(InvalidInput, words):
                Path(wrong)


if __name__ == "__main__":
    unittest.main()
