# SPDX-License-Identifier: BSD-3-Clause
"""The output of help(strainwave)."""
import pydoc
import unittest

import strainwave


class ThePackage(unittest.TestCase):
    def test_shows_its_classes_and_exceptions_to_who_asks_for_help(self):
        classes = (strainwave.Joint, strainwave.Path, strainwave.Stream, strainwave.InvalidInput, strainwave.NoAnswer, strainwave.Refused,
                   strainwave.Faulted, strainwave.NotDone, strainwave.Yielded)
        for one in classes:
            with self.subTest(one):
                self.assertIn(one.__name__, strainwave.__doc__)
        text = pydoc.plain(pydoc.render_doc(strainwave))
        for words in ("class Joint(", "class Path(", "class Stream(", "class Refused(", "put(self, t, position_rad"):
            with self.subTest(words):
                self.assertIn(words, text)

    def test_has_all_that_it_names(self):
        for name in strainwave.__all__:
            self.assertTrue(hasattr(strainwave, name), name)


if __name__ == "__main__":
    unittest.main()
