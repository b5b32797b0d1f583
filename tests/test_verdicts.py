"""Every way in which a chapter's checks can end, as a student sees it.

    python3 tests/test_verdicts.py
"""

import json
import sys
import unittest

from fake_tools import HANG, Workbook, is_alive, scenario

WRONG = ("{'state': 'wrong', 'failure_count': 5, 'looks_like': 'a cast', 'failures': "
         "[{'what': 'cell %d' % k, 'got': '0', 'expected': '-1'} for k in range(3)]}")
CRASH = "lambda: os.kill(os.getpid(), signal.SIGSEGV)"


class Verdicts(Workbook):
    def verdict(self, state, code, *cases, words=(), options=(), **environment):
        """The text of `check 01`, which must have this state, exit code, and words."""
        result = self.ballpit("check", "01", *options, scenario=scenario(*cases), **environment)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertRegex(result.stdout, rf"(?m)^{state}  chapters/01_first/first.cuh$")
        for word in words:
            self.assertIn(word, result.stdout)
        return result.stdout

    def test_correct_names_file_backends_and_seed(self):
        self.verdict("CORRECT", 0, ("a", "{}"), ("b", "{}"), options=["--seed", "7"], words=[
            "tested on cpu, seed 7", "not tested on cuda: no GPU here", "2 of 2 checks passed",
            "speed: yours 3 ms, the solution's 2 ms, ratio 1.50 (1000 balls, medians of 5)"])

    def test_the_answer_to_the_lessons_question_waits_for_a_right_solution(self):
        measured = "{'event': 'measured', 'text': '64 cells'}, "
        self.verdict("CORRECT", 0, ("a", measured + "{}"), words=["measured: 64 cells"])
        self.assertNotIn("64 cells", self.verdict("WRONG", 13, ("a", measured + WRONG)))

    def test_todo_names_places_and_tasks_and_counts_what_passes(self):
        hole = "{'event': 'hole', 'id': 'first.other'}, "
        behind = WRONG.replace("{", "{'open': True, ", 1)
        text = self.verdict("TODO", 10, ("a", "{}"), ("b", hole + behind), ("c", "{'open': True}"),
                            words=["chapters/01_first/first.cuh:10  first.other: Return two",
                                   "1 of 3 checks passed already", "./ballpit hint 01 first.other"])
        self.assertNotIn("looks like", text)

    def test_a_filled_hole_that_is_wrong_shows_beside_an_open_one(self):
        hole = "{'event': 'hole', 'id': 'first.other'}, "
        behind = WRONG.replace("{", "{'open': True, ", 1)
        text = self.verdict("TODO", 10, ("b", hole + behind), ("first.value", WRONG), words=[
            "1 open hole", "wrong: first.value (cpu)", "looks like: a cast", "0 of 2 checks passed",
            "./ballpit check 01 --case first.value", "./ballpit hint 01 first.value\n"])
        self.assertNotIn("wrong: b", text)

    def test_the_fourth_failure_and_those_behind_it_get_a_line_each(self):
        text = self.verdict("WRONG", 13, *[(name, WRONG) for name in "abcde"], words=[
            "wrong: c (cpu)", "also wrong", "  d (cpu)  cell 0: got 0, expected -1\n  e (cpu)"])
        self.assertNotIn("wrong: d (cpu)", text)
        self.assertIn("./ballpit hint 01 HOLE  (HOLE: first.value, first.other)", text)

    def test_wrong_shows_three_elements_a_guess_and_the_next_commands(self):
        self.verdict("WRONG", 13, ("a", WRONG), ("b", "{}"), ("c", WRONG), words=[
            "wrong: a (cpu)", "should hold: a is right", "cell 2: got 0, expected -1",
            "... and 2 more", "looks like: a cast", "wrong: c (cpu)", "1 of 3 checks passed",
            "./ballpit check 01 --case a --seed 1", "./ballpit explain a", "./ballpit hint 01"])

    def test_a_chapter_left_out_of_a_build_without_graphics_says_so_in_one_line(self):
        self.write("build/cpu-release/build.ninja", "")
        self.write("build/cpu-release/bin/nothing", "")
        self.write("build/cpu-release/left_out", "01\n")
        for command in (["check", "01"], ["run", "01"], ["watch", "01"]):
            self.refuses(["chapter 01 needs graphics", "docs/dependencies.md"], *command)
        self.solve("02_second")
        self.assertEqual(self.ballpit("check", "02", "--no-speed").returncode, 0)
        proved = self.ballpit("prove")
        self.assertIn("skipped: chapter 01 needs graphics", proved.stdout)
        self.assertNotIn("  01 the starter", proved.stdout)
        self.assertIn("  02 the starter", proved.stdout)

    def test_racy_and_cuda_error_have_their_order(self):
        racy, cuda = "{'state': 'racy', 'message': 'reversed'}", "{'state': 'cuda error'}"
        self.verdict("RACY", 14, ("a", racy), ("b", "{}"), words=["racy: a (cpu)", "reversed"])
        self.verdict("WRONG", 13, ("a", racy), ("b", WRONG))
        self.verdict("CUDA ERROR", 12, ("a", WRONG), ("b", cuda), words=["CUDA error: b (cpu)"])

    def test_a_crash_does_not_hide_the_checks_behind_it(self):
        self.verdict("WRONG", 13, ("a", CRASH), ("b", "{}"), ("c", WRONG), words=[
            "crashed: a (cpu)", "segmentation fault", "wrong: c (cpu)", "1 of 3 checks passed"])

    def test_after_five_crashes_it_stops(self):
        text = self.verdict("WRONG", 13, *[(f"a{k}", CRASH) for k in range(9)],
                            words=["the checks behind the fifth crash did not run"])
        self.assertEqual(text.count("crashed: "), 5)

    def test_out_of_bounds_is_the_reason_of_the_crash(self):
        line = "out of bounds: cells[8], but it has 8 elements"
        crash = f"lambda: print('{line}', flush=True), lambda: os.abort()"
        text = self.verdict("WRONG", 13, ("a", crash), words=[line])
        self.assertNotIn("more lines", text)

    def test_an_exit_in_the_middle_is_no_success(self):
        self.verdict("WRONG", 13, ("a", "lambda: os._exit(0)"),
                     words=["ended itself with exit code 0"])

    def test_a_timeout_names_check_and_limit_and_ends_the_program(self):
        self.verdict("WRONG", 13, ("a", "{}"), ("b", HANG), ("c", "{}"),
                     options=["--time-limit", "0.7"],
                     words=["did not end: b (cpu)", "stopped after 0.7 s; the checks behind it"])
        self.assertFalse(is_alive(int((self.root / "pid").read_text())))

    def test_prints_are_shown_up_to_a_limit(self):
        text = self.verdict("CORRECT", 0, ("a", "lambda: print(*range(100), sep='\\n'), {}"),
                            words=["| 39\n| ... and 60 more lines"])
        self.assertNotIn("| 40", text)

    def test_a_flood_of_prints_is_stopped(self):
        flood = "lambda: [os.write(1, b'x' * 100000) for k in range(10000)]"
        text = self.verdict("WRONG", 13, ("a", flood), ("b", "{}"),
                            words=["printed more than 100 MB", "1 of 2 checks passed"])
        self.assertEqual(text.count("crashed: "), 1)

    def test_no_check_at_all_is_no_success(self):
        self.refuses(["reported no check"], "check", "01", scenario="[()][1:]", code=1)

    def test_json_is_one_line_with_all_of_it(self):
        result = self.ballpit("check", "01", "--json", scenario=scenario(
            ("a", "lambda: print('mine', flush=True), {}"), ("b", WRONG)))
        verdict = json.loads(result.stdout)
        self.assertEqual([verdict[name] for name in ("state", "exit_code", "passed", "seed")],
                         ["WRONG", 13, 1, 1])
        self.assertEqual(verdict["failed"][0]["failure_count"], 5)

    def test_the_reference_is_tested_on_demand(self):
        result = self.ballpit("check", "01", "--reference")
        self.assertEqual(result.returncode, 0)
        self.assertIn("CORRECT  solutions/01_first/first.cuh", result.stdout)


class CompileErrors(Workbook):
    def error(self, *log):
        """The verdict on a build that printed these lines; "{root}" is the project's folder."""
        log = "\n".join(log).replace("{root}", str(self.root))
        result = self.ballpit("check", "01", FAKE_LOG=str(self.write("log", log + "\n")))
        self.assertEqual(result.returncode, 11, result.stderr)
        self.assertTrue(result.stdout.startswith("DOES NOT BUILD  chapters/01_first/first.cuh"))
        self.assertIn("all of it: build/logs/build_check_01.log", result.stdout)
        return result.stdout

    def test_the_first_error_in_a_students_file(self):
        text = self.error("{root}/common/x.cuh:3:1: error: an echo",
                          "{root}/chapters/01_first/first.cuh:6:12: error: expected ';'",
                          "{root}/chapters/01_first/first.cuh:9:1: error: another")
        self.assertIn("chapters/01_first/first.cuh:6:12: expected ';'\n        return 0;\n"
                      + " " * 15 + "^\n", text)
        self.assertNotIn("echo", text)
        self.assertNotIn("another", text)

    def test_a_path_may_be_told_from_the_build_folder(self):
        text = self.error("../../chapters/01_first/first.cuh:6:12: error: expected ';'")
        self.assertIn("\nchapters/01_first/first.cuh:6:12: expected ';'\n        return 0;\n", text)

    def test_an_error_inside_the_engine_leads_back_to_the_student(self):
        place = "{root}/chapters/01_first/first.cuh:5"
        for lines in [("{root}/common/x.cuh: In instantiation of 'f<int>':",
                       place + ":12:   required from here",
                       "{root}/common/x.cuh:3:1: error: no match"),
                      ("{root}/common/x.cuh:3:1: error: no match",
                       place + ":12: note: in instantiation of function template"),
                      ("{root}/common/x.cuh(3): error: no match",
                       '  detected during instantiation of "f" at line 5 of '
                       "{root}/chapters/01_first/first.cuh")]:
            text = self.error(*lines)
            self.assertRegex(text, r"chapters/01_first/first.cuh:5(:12)?: no match\n")
            self.assertIn("stumbled in common/x.cuh:3", text)

    def test_a_missing_brace_is_looked_for_in_the_holes(self):
        piece = self.root / "chapters/01_first/first.cuh"
        piece.write_text(piece.read_text().replace("return 0;", "if (true) {", 1))
        text = self.error("/usr/include/c++/std_function.h:55:3: error: expected class-name")
        self.assertIn("hole first.value has 1 of { and 0 of }", text)
        self.assertNotIn("class-name", text)

    def test_nvcc_and_the_linker(self):
        self.assertIn("first.cuh:5: expected a \";\"",
                      self.error('{root}/chapters/01_first/first.cuh(5): error: expected a ";"'))
        self.assertIn("undefined reference to `value'",
                      self.error("/usr/bin/ld: x.o: undefined reference to `value'"))

    def test_a_failure_of_the_tools_is_not_the_students(self):
        log = self.write("log", "ninja: no space left on device\n")
        self.refuses(["build/logs/build_check_01.log"], "check", "01", FAKE_LOG=str(log), code=1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
