#!/usr/bin/env bash
# Everything that only a real GPU can show: builds with CUDA, then tests, CPU and GPU hashes side by
# side, compute-sanitizer, the bench, and the price of exactness. For machines with an NVIDIA GPU.
#     tools/verify_gpu.sh OUT_FOLDER [build|hashes|checks|tests|sanitizer|...]
# The part `lessons`, only on request, measures the lessons' tables in docs/results anew.
set -u
cd "$(dirname "$0")/.."
out=${1:?usage: tools/verify_gpu.sh OUT_FOLDER [part ...]}
shift
parts=${*:-build hashes checks tests sanitizer bench exactness}
mkdir -p "$out"
bin=build/cuda-release/bin
failed=0
step() { printf '\n== %s\n' "$*"; }
run() { "$@" || { echo "FAILED: $*"; failed=1; }; }

configure() { # preset, further options
    cmake --preset "$@" -DCMAKE_CUDA_ARCHITECTURES=native ${BALLPIT_CMAKE_ARGS:-}
}

check_solution() { # program, begin of its logs' names
    local end=""
    timeout 300 "$1" >"$2.log" 2>&1 || end=" FAILED"
    timeout 300 compute-sanitizer --tool memcheck --error-exitcode 9 "$1" --device cuda \
        >"$2.memcheck.log" 2>&1 || end="$end FAILED under memcheck"
    echo "$(basename "$1"): $(grep -c '^passed' "$2.log") passed," \
        "$(grep -c -v -e '^passed' -e '^ ' "$2.log") other lines;" \
        "$(grep -h 'ERROR SUMMARY' "$2.memcheck.log")$end" >"$2.summary"
}

for part in $parts; do
    step "$part"
    case $part in
    build)
        run configure cuda-release >"$out/configure.log"
        tail -4 "$out/configure.log"
        cmake --build build/cuda-release >"$out/build.log" 2>&1 || { tail -40 "$out/build.log"; exit 1; }
        ;;
    hashes)
        for arguments in "--scene gravity_fall --count 500 --frames 500" \
            "--plan original --count 500 --frames 500" \
            "--scene gravity_fall --count 20000 --frames 200" \
            "--plan original --scene gas --count 100000 --frames 100" \
            "--plan original --scene pile --count 100000 --frames 100" \
            "--plan original --scene uniform --count 1000000 --frames 20"; do
            for device in cpu cuda; do
                # shellcheck disable=SC2086
                $bin/gravity_fall $arguments --device $device --json 2>/dev/null |
                    python3 -c 'import json,sys; print(json.load(sys.stdin)["state_hash"])' >"$out/hash.$device"
            done
            if cmp -s "$out/hash.cpu" "$out/hash.cuda" && [ -s "$out/hash.cpu" ]; then
                echo "same bits: $arguments: $(cat "$out/hash.cpu")"
            else
                echo "DIFFERENT: $arguments: $(cat "$out/hash.cpu" "$out/hash.cuda" | tr '\n' ' ')"
                failed=1
            fi
        done
        rm -f "$out"/hash.*
        ;;
    checks) # of the chapters, all at the same time: solutions on CPU and GPU, under memcheck too
        rm -f "$out"/*.summary
        for check in $bin/check_*_reference; do
            check_solution "$check" "$out/$(basename "$check")" &
        done
        wait
        cat "$out"/*.summary
        ! grep -q FAILED "$out"/*.summary || failed=1
        ;;
    tests)
        ctest --test-dir build/cuda-release --output-on-failure -j 4 >"$out/tests.log" 2>&1 || failed=1
        grep -E "Failed|Skipped|Not Run|tests passed|tests failed" "$out/tests.log" | tail -30
        ;;
    sanitizer)
        for tool in memcheck racecheck initcheck; do
            compute-sanitizer --tool $tool --error-exitcode 9 $bin/gravity_fall --device cuda --count 3000 \
                --frames 40 >"$out/$tool.log" 2>&1 &
        done
        wait
        for tool in memcheck racecheck initcheck; do
            grep -E "ERROR SUMMARY|RACECHECK SUMMARY" "$out/$tool.log" | sed "s/^/$tool: /"
            grep -q "SUMMARY: 0 " "$out/$tool.log" || { echo "FAILED: $tool"; failed=1; }
        done
        ;;
    bench) run $bin/ballpit_bench --device cuda --csv "$out/bench_cuda.csv" | tee "$out/bench_cuda.txt" ;;
    lessons)
        run python3 tools/measure_chapters.py --cuda
        run python3 tools/profile_chapters.py --keep "$out/ncu"
        ;;
    exactness)
        run configure cuda-release -B build/cuda-inexact -DBALLPIT_EXACT=OFF -DBUILD_TESTING=OFF >/dev/null
        run cmake --build build/cuda-inexact --target ballpit_bench >/dev/null
        for round in 1 2 3; do
            for build in cuda-release cuda-inexact; do
                echo "-- $build, round $round"
                build/$build/bin/ballpit_bench --device cuda --scenes gas --counts 1000000 8000000 \
                    --repeats 31 | sed -n '/Whole steps/,$p'
            done
        done | tee "$out/exactness.txt"
        ;;
    *) echo "unknown part: $part"; exit 2 ;;
    esac
done
exit $failed
