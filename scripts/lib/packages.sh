# shellcheck shell=bash
# Sourced by the scripts: the Debian packages that the project needs, and how the missing ones get here.
# This list is the only one; add any package that a bare machine lacks.

# shellcheck source=common.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/common.sh"

# package | build: for building and comparing; report: for the report of a comparison; test, docs, package, page, fuzz, tidy:
# only for tests, reference, ... | what for
packages()
{
    cat <<'LIST'
g++                          | build | the C++17 compiler
make                         | build page | runs the build
cmake                        | build page | configures the build (3.25 or later)
libeigen3-dev                | build page | Eigen: linear algebra, splines
libompl-dev                  | build | OMPL, the Open Motion Planning Library
libfcl-dev                   | build | FCL: collision queries
libccd-dev                   | build | libccd: the collision solver under FCL
libceres-dev                 | build | Ceres: the solver of the model predictive controller
libboost-dev                 | build | Boost's headers (heap, DLL), also needed by OMPL's
libboost-program-options-dev | build | reads the .cfg files
libboost-filesystem-dev      | build | loads planner plug-ins, with Boost.DLL
libyaml-cpp-dev              | build | reads scenarios and maps
nlohmann-json3-dev           | build | writes results as JSON
libpng-dev                   | build | reads maps in PNG
libbenchmark-dev             | build | Google Benchmark, for the micro-benchmarks
libsqlite3-dev               | build | SQLite: the database of a comparison
python3                      | build page | reports from the database; checks of the tests
python3-dev                  | build | the Python module, on which parking_convert is built
pybind11-dev                 | build | pybind11: the Python module
python3-numpy                | build report test package | arrays of the Python module and of reports
python3-scipy                | build report test | parking_convert: MATLAB files, hulls of points; statistics of reports
python3-jinja2               | report test | pages of reports
python3-plotly               | report test | charts of reports
libgtest-dev                 | test  | GoogleTest
ompl-demos                   | test  | ompl_benchmark_statistics, whose database ours is compared with
pkg-config                   | test  | the consumer that finds the installed package by pkg-config
git                          | test  | names the files that the style tests look at
clang-format                 | test  | checks the format of the sources
shellcheck                   | test  | checks the shell scripts
doxygen                      | test docs | reads the docstrings, which must not make it warn
python3-sphinx               | docs  | Sphinx: makes the site and its search
furo                         | docs  | Furo: what the site looks like
python3-myst-parser          | docs  | MyST: reads guides in Markdown
python3-breathe              | docs  | Breathe: what Doxygen read, for Sphinx
python3-pil                  | docs  | Pillow: reduces the photograph of scripts/pictures --report
python3-yaml                 | test docs | PyYAML: reads scenarios for scripts/pictures
dpkg-dev                     | test package | finds out what packages a library needs
help2man                     | package | writes the manual pages of the programs
file                         | test package | tells programs from other files
python3-matplotlib           | test  | pictures of the Python module
python3-pandas               | test  | tables of the Python module
python3-pytest               | test  | runs the tests of the Python module
emscripten                   | page  | compiles the core for browsers (800 MB)
node-js-yaml                 | page  | js-yaml: reads scenarios in the page
clang                        | fuzz  | builds what scripts/fuzz runs, instrumented
libclang-rt-dev              | fuzz  | libFuzzer and clang's sanitizers
clang-tidy                   | tidy  | checks the sources for likely bugs
LIST
}

# packages_for PART...: name and purpose, one per line.
packages_for()
{
    packages | awk -F ' *[|] *' -v wanted=" $* " '{
        count = split($2, parts, " ")
        for (i = 1; i <= count; ++i)
            if (index(wanted, " " parts[i] " ")) {
                print $1 "\t" $3
                next
            }
    }'
}

is_installed()
{
    [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

# Runs a command as root, or fails when there is no way to without asking for a password.
as_root()
{
    if [[ $(id -u) == 0 ]]; then
        "$@"
    else
        sudo --non-interactive "$@"
    fi
}

can_be_root()
{
    [[ $(id -u) == 0 ]] || sudo --non-interactive true 2>/dev/null
}

# require_packages PART...: installs what is missing, and touches neither apt nor the network when nothing is.
require_packages()
{
    local package purpose total=0
    local -a missing=() reasons=()
    if ! command -v dpkg-query >/dev/null; then
        say "This is no Debian or Ubuntu: the packages cannot be checked. What is needed, by Debian's names:"
        packages_for "$@" | while IFS=$'\t' read -r package purpose; do
            printf '    %-28s  %s\n' "$package" "$purpose"
        done
        return 0
    fi
    while IFS=$'\t' read -r package purpose; do
        total=$((total + 1))
        if ! is_installed "$package"; then
            missing+=("$package")
            reasons+=("$(printf '    %-28s  %s' "$package" "$purpose")")
        fi
    done < <(packages_for "$@")
    if ((${#missing[@]} == 0)); then
        say "All $total packages are installed."
        return 0
    fi
    say "${#missing[@]} of $total packages are missing:"
    printf '%s\n' "${reasons[@]}"
    if ! can_be_root; then
        {
            printf 'Installing them takes root, and sudo would ask for a password. Please run\n\n'
            printf '    sudo apt-get update && sudo apt-get install --yes --no-install-recommends %s\n\n' "${missing[*]}"
            printf 'and then this script again.\n'
        } >&2
        exit 2
    fi
    install_packages "${missing[@]}"
}

install_packages()
{
    local package
    # Freshly started machines may still be busy with their first updates: wait for the lock instead of failing.
    local -a apt=(env DEBIAN_FRONTEND=noninteractive apt-get --quiet --option DPkg::Lock::Timeout=600)
    say "apt-get update"
    as_root "${apt[@]}" update || say "apt-get update failed; trying with the package lists that are there."
    say "apt-get install --no-install-recommends $*"
    as_root "${apt[@]}" install --yes --no-install-recommends "$@" ||
        die "apt-get could not install the missing packages (see above); is there a network?"
    for package in "$@"; do
        is_installed "$package" || die "apt-get has run, but the package $package is still not installed"
    done
}
