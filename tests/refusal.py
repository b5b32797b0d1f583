"""What every program does with bad input: exit code 2 and one line on stderr that says what is wrong."""


def assert_refused(case, result, words):
    """`result` of a finished process, for a unittest `case`: the line has all `words`."""
    case.assertEqual(result.returncode, 2, result.stderr)
    case.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
    case.assertTrue(result.stderr.startswith("error: "), result.stderr)
    for word in words:
        case.assertIn(word, result.stderr)
