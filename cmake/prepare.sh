# Read by ./reproduce, ./check, .ci/run, tests/long and tests/long.d: what the build needs, installed
# where it is missing, and the build itself. Everything printed here goes to standard error.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

build_packages=(
    g++ cmake ninja-build pkg-config ccache
    libembree-dev libopenexr-dev libopenimageio-dev libceres-dev libeigen3-dev libglm-dev
    libusb-1.0-0-dev libtbb-dev libcli11-dev libfmt-dev nlohmann-json3-dev libyaml-cpp-dev
    libgtest-dev libbenchmark-dev zlib1g-dev
    libumockdev-dev umockdev # virtual USB devices, tests only
    libopenmpi-dev openmpi-bin # optional: `mpirun ... drude render`, a module of its own
)

say() { printf '%s\n' "$*" >&2; }

# install_missing PACKAGE...: asks dpkg, which needs no network, and apt only for what is missing.
install_missing() {
    if ! command -v dpkg-query > /dev/null; then
        say "This is no Debian: install what corresponds to $*, if it is not there already."
        return
    fi
    local package missing=()
    local -A installed=()
    while read -r package; do
        installed[$package]=1
    done < <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2> /dev/null |
        sed -n 's/^installed //p')
    for package; do
        [[ -n ${installed[$package]:-} ]] || missing+=("$package")
    done
    ((${#missing[@]} == 0)) && return
    local as_root=()
    if ((EUID != 0)); then
        if ! command -v sudo > /dev/null; then
            say "Found neither root's rights nor sudo; run as root: apt-get install ${missing[*]}"
            return 3
        fi
        as_root=(sudo)
    fi
    say "Installing ${missing[*]}"
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -q)
    if ! "${apt[@]}" update >&2 ||
        ! "${apt[@]}" install --no-install-recommends "${missing[@]}" >&2; then
        say "apt-get could not install: ${missing[*]}"
        return 3
    fi
}

# build_in build/ -DOPTION... -- TARGET...: an optimised build for this machine. DRUDE_ISA in the
# environment chooses another instruction set: portable, v3 (AVX2) or native.
build_in() {
    local options=() targets=()
    while (($# > 0)) && [[ $1 != -- ]]; do
        options+=("$1")
        shift
    done
    shift
    (($# > 0)) && targets=(--target "$@")
    local log=$root/build/configure.log
    mkdir -p "$root/build"
    if ! cmake -S "$root" -B "$root/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DDRUDE_ISA="${DRUDE_ISA:-native}" "${options[@]}" > "$log" 2>&1; then
        cat "$log" >&2
        return 3
    fi
    cmake --build "$root/build" "${targets[@]}" >&2
}
