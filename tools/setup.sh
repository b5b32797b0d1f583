# The packages that Ballpit needs, and their installation. Sourced by sh; expects $root, the
# project's folder.

# Debian's and Ubuntu's names. What each is for: docs/dependencies.md.
packages="g++ cmake ninja-build pkg-config python3 libcli11-dev nlohmann-json3-dev catch2
libgl-dev libegl-dev libx11-dev libglu1-mesa-dev libglew-dev libgl1-mesa-dri
freeglut3-dev libfreetype-dev fonts-dejavu-core
libavcodec-dev libavformat-dev libswscale-dev"

# Installed by `./ballpit chart` alone.
chart_packages="python3-matplotlib"

# Not needed and not installed: other engines, for `./ballpit chart --peers` (docs/peers.md).
# shellcheck disable=SC2034  # read by .ci/run
peer_packages="libbullet-dev libode-dev"

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
    # A folder that cannot be written is reported later, by what must write there.
    log=$root/build/logs/packages.log
    mkdir -p "$root/build/logs" 2>/dev/null
    [ -w "$root/build/logs" ] || log=${TMPDIR:-/tmp}/ballpit_packages.log
    # The environment is set through env, because sudo drops it.
    if ! { $as_root apt-get update -q && $as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends $missing; } >"$log" 2>&1; then
        tail -5 "$log" >&2
        echo "error: the packages could not be installed; all of it: $log" >&2
        exit 2
    fi
}
