# SPDX-License-Identifier: BSD-3-Clause
"""The campaign of `./dev test --flakes` names what fails now and then."""

import contextlib
import io
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/dev"))
import flakes  # noqa: E402
import run_tests  # noqa: E402


class Flakes(unittest.TestCase):
    @staticmethod
    def now_and_then(number):
        failed = ["S.B"] if number in (3, 5) else []
        return run_tests.Result(passed=2 - len(failed), failed=failed, output=f"[ RUN      ] S.B\nvalue {number}\n")

    def campaign(self, *programs):
        told = io.StringIO()
        with contextlib.redirect_stdout(told):
            campaign = flakes.Campaign()
            for number in range(1, 7):
                campaign.run_round(number, 6, programs)
            status = campaign.print_result(6)
        return status, told.getvalue()

    def test_are_named_with_their_rounds(self):
        status, told = self.campaign(("steady", lambda _: run_tests.Result(passed=3)), ("other", self.now_and_then))
        self.assertEqual(status, 1)
        self.assertTrue(told.endswith("flaky: other: S.B: failed in 2 of 6 rounds: 3, 5\n28 passed, 2 failed\n"), told)
        self.assertRegex(told, r"round 3 of 6: other: 1 FAILED  \([\d.]+ s\)\n    \| S.B\n    \| value 3\n")
        self.assertRegex(told, r"round 4 of 6: other: ok ")

    def test_none_is_success(self):
        status, told = self.campaign(("steady", lambda _: run_tests.Result(passed=3)))
        self.assertEqual((status, told.splitlines()[-1]), (0, "18 passed, 0 failed"))

    def test_the_load_ends_with_the_campaign(self):
        with flakes.Load(2) as load:
            self.assertEqual([loop.poll() for loop in load.loops], [None, None])
        self.assertEqual([loop.poll() for loop in load.loops], [-9, -9])



if __name__ == "__main__":
    unittest.main()
