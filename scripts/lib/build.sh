# shellcheck shell=bash
# Sourced by the scripts: configures and builds a preset in build/<preset>.

# shellcheck source=packages.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/packages.sh"

# require_cmake MAJOR.MINOR: the presets need this version.
require_cmake()
{
    local found
    command -v cmake >/dev/null || die "cmake is not installed"
    found=$(cmake --version | awk 'NR == 1 { print $3 }')
    if [[ $(printf '%s\n' "$1" "$found" | sort --version-sort | head -n 1) != "$1" ]]; then
        die "cmake $found is too old, $1 or later is needed (Debian 12 has it)"
    fi
}

# The compiler that CMake will take.
require_compiler()
{
    local compiler=${CXX:-c++}
    command -v "${compiler%% *}" >/dev/null || die "there is no C++ compiler $compiler; Debian's package is g++"
}

# require_space MEGABYTES: what a build takes in the end; without it the compiler fails in odd ways.
require_space()
{
    local free
    free=$(df --output=avail --block-size=1M -- "$project_root" | tail -n 1)
    if ((free < $1)); then
        die "$project_root: $((free)) MB of disk are free, the build takes up to $1 MB"
    fi
}

# configure_preset PRESET [CMAKE ARGUMENT...]
configure_preset()
{
    local preset=$1 cache=$project_root/build/$1/CMakeCache.txt
    local -a fresh=()
    shift
    require_cmake 3.25
    require_compiler
    require_space 1000
    # A build folder that was copied along with the project belongs to another place: CMake refuses it.
    if [[ -f $cache ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$project_root" "$cache"; then
        fresh=(--fresh)
    fi
    say "Configuring the preset $preset in build/$preset"
    if ! (cd -- "$project_root" && cmake --preset "$preset" "${fresh[@]}" "$@"); then
        say "FAILED: the project could not be configured"
        exit 1
    fi
}

# build_preset PRESET [TARGET...]: everything, or the targets given.
build_preset()
{
    local preset=$1 jobs started=$SECONDS
    local -a targets=()
    shift
    if (($# > 0)); then
        targets=(--target "$@")
    fi
    jobs=$(compile_jobs)
    say "Building build/$preset with $jobs jobs on $(nproc) cores"
    if ! cmake --build "$project_root/build/$preset" --parallel "$jobs" "${targets[@]}"; then
        say "FAILED: the project could not be built. The compiler's message is above; was it killed, try PARKING_JOBS=1."
        if grep -qx 'PARKING_WARNINGS_AS_ERRORS:[A-Z]*=ON' "$project_root/build/$preset/CMakeCache.txt"; then
            say "Was it a warning of a compiler newer than ours (GCC 12)? scripts/compare --allow-warnings goes on."
        fi
        exit 1
    fi
    say "Built in $(duration $((SECONDS - started)))"
}
