# What `ballpit` needs before it can run anything: packages, configuration, build. Sourced by sh;
# expects $root, the project's folder.

# Debian's and Ubuntu's names. What each is for: docs/dependencies.md.
packages="g++ cmake ninja-build pkg-config python3 libcli11-dev nlohmann-json3-dev catch2
libgl-dev libegl-dev libglew-dev libgl1-mesa-dri
libavcodec-dev libavformat-dev libswscale-dev"

# The packages of the list "$1" that are not installed.
missing_packages() {
    for package in $1; do
        state=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null)
        [ "$state" = "install ok installed" ] || printf '%s ' "$package"
    done
}

# Installs the packages of the list "$1" that are missing.
install_packages() {
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        echo "error: this system has no apt-get. Install what these Debian packages hold, then" \
            "call again with --no-install:" $1 >&2
        exit 2
    fi
    missing=$(missing_packages "$1")
    [ -z "$missing" ] && return
    as_root=""
    if [ "$(id -u)" -ne 0 ]; then
        as_root=sudo
        if ! command -v sudo >/dev/null; then
            echo "error: as root, install these packages: apt-get install $missing" >&2
            exit 2
        fi
    fi
    echo "installing: $missing" >&2
    # The environment is set through env, because sudo drops it.
    if ! { $as_root apt-get update -q && $as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends $missing; } >"$logs/packages.log" 2>&1; then
        tail -5 "$logs/packages.log" >&2
        echo "error: the packages could not be installed; all of it: $logs/packages.log" >&2
        exit 2
    fi
}

# "cuda" if nvcc and a GPU are here, else "cpu".
detect_machine() {
    if { command -v nvcc || [ -x /usr/local/cuda/bin/nvcc ]; } >/dev/null 2>&1 &&
        nvidia-smi -L 2>/dev/null | grep -q GPU; then
        echo cuda
    else
        echo cpu
    fi
}

# Runs "$@" quietly; on failure shows the end of its output and stops.
quietly() {
    log=$1
    shift
    "$@" >"$log" 2>&1 && return
    # The first error is the one to mend; what follows it is often an echo.
    grep -n -i -m 3 -A 6 -E '(error|fatal)[: ]' "$log" >&2 || tail -20 "$log" >&2
    echo "error: this failed: $*; all of it: $log" >&2
    exit 1
}

# prepare MACHINE INSTALL TARGET: sets $build to a folder in which TARGET is built.
prepare() {
    logs=$root/build/logs
    if ! mkdir -p "$logs" 2>/dev/null; then
        echo "error: $root/build cannot be written: copy the project to a folder of your own" >&2
        exit 2
    fi
    [ "$2" = yes ] && install_packages "$packages"
    for tool in cmake ninja c++; do
        if ! command -v "$tool" >/dev/null; then
            echo "error: $tool is missing; call again without --no-install" >&2
            exit 2
        fi
    done
    preset=$1
    [ "$preset" = auto ] && preset=$(detect_machine)
    preset=$preset-release
    build=$root/build/$preset
    # Configured once; later CMake itself sees what changed.
    if [ ! -f "$build/build.ninja" ]; then
        echo "configuring $preset" >&2
        (cd "$root" && quietly "$logs/configure.log" cmake --preset "$preset") || exit 1
    fi
    [ -x "$build/bin/$3" ] || echo "building $3 (a minute or two the first time)" >&2
    quietly "$logs/build.log" cmake --build "$build" --target "$3"
}
