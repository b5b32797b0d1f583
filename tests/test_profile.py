"""How the lessons' profiler tables are read from what Nsight Compute prints.

    python3 tests/test_profile.py
"""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))

import profile_chapters
from profile_chapters import BUS, WAITING, Profile, Row, kernel, percent, plain

THREADS = "_ZN7ballpit14threadPerIndexIXadL_ZNS_"
# As ncu 2025.3 prints it; the bus of each launch is another number.
PRINTED = f'''\
==PROF== Connected to process 1070 (/x/07_impulse_response_reference)
07 impulse_response: one round
  count  1000000
"ID","Kernel Name","Block Size","Grid Size","Device","CC","{BUS}","{WAITING}"
"","","","","","","%","inst"
"0","{THREADS}21collisionResponseRacyEiNS_","(256, 1, 1)","(1, 1, 1)","0","9.0","0.03","9.5"
"1","{THREADS}21collisionResponseRacyEiNS_","(256, 1, 1)","(3907, 1, 1)","0","9.0","29.4","47.66"
"2","{THREADS}17collisionResponseEiNS_13R","(256, 1, 1)","(3907, 1, 1)","0","9.0","39.85","50.81"
"3","{THREADS}17collisionResponseEiNS_13R","(256, 1, 1)","(3907, 1, 1)","0","9.0","41.0","1,050.8"
"4","{THREADS}17collisionResponseEiNS_13R","(256, 1, 1)","(1, 1, 1)","0","9.0","0.05","8.82"
"5","{THREADS}11countAroundILb0EEEviNS_8G","(256, 1, 1)","(4, 1, 1)","0","9.0","1.0","1.0"
"6","{THREADS}11countAroundILb1EEEviNS_8G","(256, 1, 1)","(4, 1, 1)","0","9.0","2.0","2.0"
==PROF== Disconnected from process 1070
'''


def cells(row):
    profile = Profile("07_impulse_response", "", 1000000, [], {WAITING: plain, BUS: percent}, [row])
    return profile_chapters.cells_of(row, profile, profile_chapters.launches(PRINTED))


class Reading(unittest.TestCase):
    def test_a_function_is_told_from_one_whose_name_begins_alike(self):
        self.assertEqual(cells(kernel("collisionResponseRacy")),
                         ["`collisionResponseRacy`", "47.7", "29 %"])
        self.assertEqual(cells(kernel("collisionResponse", 0)),
                         ["`collisionResponse`", "50.8", "40 %"])

    def test_of_large_and_small_launches_the_large_ones_count(self):
        self.assertEqual(cells(kernel("collisionResponse")),
                         ["`collisionResponse`", "1050", "41 %"])

    def test_instances_of_a_template_are_told_apart(self):
        for template, number in {"ILb0E": "1", "ILb1E": "2"}.items():
            self.assertEqual(cells(Row(["rows"], "countAround", template=template)),
                             ["rows", number, f"{number} %"])

    def test_the_body_of_a_colour_is_found_within_the_kernel_that_runs_it(self):
        name = f"{THREADS}12pairOfColourIXadL_ZNS_9pushApartEjNS_13SmallStepViewEbEEJS2_bEEEvi"
        found = [{"Kernel Name": name, "Grid Size": "(1954, 1, 1)", BUS: number}
                 for number in ("40", "7")]
        self.assertIs(profile_chapters.launch_of(Row([], "pushApart", 0), found), found[0])

    def test_a_chapter_may_profile_a_program_that_is_no_reference(self):
        profile = profile_chapters.PROFILES["11"][0]
        self.assertTrue(any(part.endswith("/bin/gravity_fall")
                            for part in profile_chapters.command(profile)))

    def test_a_function_that_was_never_launched_is_named(self):
        with self.assertRaisesRegex(ValueError, "no launch of linkAndCount"):
            cells(kernel("linkAndCount"))

    def test_what_ncu_complains_about_is_told(self):
        with self.assertRaisesRegex(ValueError, "ERR_NVGPUCTRPERM"):
            profile_chapters.launches("==ERROR== ERR_NVGPUCTRPERM - no permission\n")


class Command(unittest.TestCase):
    def test_a_missing_tool_is_one_line_and_exit_code_2(self):
        said = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(said), \
                mock.patch.object(sys, "argv", ["profile_chapters.py", "02"]), \
                mock.patch.dict("os.environ", {"PATH": folder}):
            self.assertEqual(profile_chapters.main(), 2)
        self.assertRegex(said.getvalue(), r"\Aerror: 'nvidia-smi' was not found: install .*\n\Z")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
