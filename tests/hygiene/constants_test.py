#!/usr/bin/env python3
"""What reads the filter's constants, and compares them with the page that measures them, finds what is wrong."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import constants  # noqa: E402
import sweep  # noqa: E402

HEADER = """
/// [share] Share that is
/// enough. By hand.
ORTUNG_CONSTANT(lead, kEnough, 0.9);
/// Samples. Cost.
ORTUNG_CONSTANT(lead, kSamples, std::size_t{1'000});
"""
PAGE = "<!-- constants -->\n## Belief\n\n### `lead`\n\n| c | v |\n|---|---|\n| `kEnough` | 0.9 | nothing | 1 of 2 |\n"


class Constants(unittest.TestCase):
    def declared(self, header):
        with tempfile.TemporaryDirectory() as root:
            room = pathlib.Path(root) / "mcl/src/belief"
            room.mkdir(parents=True)
            (room / "BeliefTuning.hpp").write_text(header)
            return constants.declared(root)

    def test_have_units_values_and_texts(self):
        enough, samples = self.declared(HEADER)
        self.assertEqual((enough.key, enough.value, enough.unit), ("lead.kEnough", 0.9, "share"))
        self.assertEqual(enough.what, "Share that is enough. By hand.")
        self.assertEqual((samples.value, samples.unit, samples.shown), (1000.0, "", "1000"))

    def test_without_a_comment_are_refused(self):
        with self.assertRaisesRegex(ValueError, "1 of 2 constants"):
            self.declared("/// One.\nORTUNG_CONSTANT(lead, kOne, 1.0);\nORTUNG_CONSTANT(lead, kTwo, 2.0);\n")

    def test_of_shares_the_odds_are_halved(self):
        enough, samples = self.declared(HEADER)
        self.assertAlmostEqual(enough.times(2.0), 18.0 / 19.0)
        self.assertAlmostEqual(enough.times(0.5), 4.5 / 5.5)
        self.assertEqual(samples.times(0.5), 500.0)

    def test_are_compared_with_the_page(self):
        declared = self.declared(HEADER)
        self.assertEqual(constants.differences(declared, PAGE), [])
        self.assertEqual(constants.unmeasured(declared, PAGE), ["lead.kSamples"])
        self.assertEqual(constants.differences(declared[:1], PAGE.replace("0.9", "0.8")),
                         ["lead.kEnough is 0.9 in the code and was 0.8 when it was measured"])
        self.assertEqual(constants.differences([], PAGE), ["lead.kEnough is in the page alone"])


    def test_that_changed_since_the_fit_are_named(self):
        declared = self.declared(HEADER)
        page = "<!-- confidence was fitted with: nothing known -->"
        self.assertIn("before its constants were noted", constants.since_the_fit(declared, page))
        page = constants.with_fit(page, declared)
        self.assertEqual(constants.since_the_fit(declared, page), "")
        self.assertIn("other values of lead.kEnough:", constants.since_the_fit(declared, page.replace("kEnough=0.9", "kEnough=0.8")))


class Changes(unittest.TestCase):
    @staticmethod
    def figures(bits="a", right=1, wrong=0.0, tracking=0.5, lost=0.0, median=0.02):
        return sweep.Figures(bits, right, wrong, tracking, lost, median)

    def test_are_told_by_their_greatest(self):
        before = [self.figures(), self.figures(), self.figures()]
        self.assertEqual(sweep.change(before, before), "nothing")
        self.assertEqual(sweep.change(before, [self.figures(bits="b"), *before[1:]]), "1 of 3")
        after = [self.figures("b", median=0.03, tracking=0.4), self.figures("b", right=0, lost=0.2), before[2]]
        self.assertEqual(sweep.change(before, after), "2 of 3, median +50 %, tracking -10.0 points, lost +20.0 points, -1 runs right")

    def test_of_times_do_not_count(self):
        result = {"converged_after_s": 1.0, "position_median_m": 0.1, "tracking_share": 1.0, "lost_share": 0.0,
                  "wrong_while_tracking_share": 0.0}
        again = {**result, "update_ms_p50": 3.0, "realtime_factor": 9.0}
        self.assertEqual(sweep.figures_of(result), sweep.figures_of(again))


if __name__ == "__main__":
    unittest.main()
