#!/bin/sh
# Runs clang-tidy over the project's own sources, as the build in folder $1 compiles them.
set -eu
cd "$(dirname "$0")/.."
build=${1:?usage: tools/tidy.sh BUILD_FOLDER}
git ls-files 'common/*.cpp' 'common/*.cu' 'solutions/*.cpp' 'bench/*.cpp' 'bench/*.cu' 'chapters/*.cu' \
    'tests/checks/*.cpp' 'tests/test_truth_*.cpp' 'truth/*.cpp' \
    'stability/*.cpp' 'stability/*.cu' 'tests/test_stability_*.cpp' 'chart/*.cpp' 'chart/*.cu' |
    grep -v without_ |
    xargs -P 2 -n 2 clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option \
        --extra-arg=-Wreserved-identifier
