# shellcheck shell=bash
# Sourced by the scripts: where the project is, how they speak, how many jobs the machine can bear.

project_root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../.." && pwd -P)
export project_root

# In bold on terminals with colours, and red for a failure, unless NO_COLOR is set (https://no-color.org).
say()
{
    if [[ -t 1 && -z ${NO_COLOR:-} && ${TERM:-dumb} != dumb ]]; then
        printf '\033[%sm==> %s\033[0m\n' "$([[ $1 == FAILED* ]] && printf '1;31' || printf 1)" "$*"
    else
        printf '==> %s\n' "$*"
    fi
}

# An error of the caller or of the machine: one message, status 2.
die()
{
    printf '%s: %s\n' "$(basename -- "$0")" "$*" >&2
    exit 2
}

# answer_help ARGUMENT...: prints the help, which it reads, and ends the script, if --help is among the arguments before --.
answer_help()
{
    local argument help
    help=$(cat)
    for argument in "$@"; do
        case $argument in
            --) return ;;
            -h | --help)
                printf '%s\n' "$help"
                exit 0
                ;;
        esac
    done
}

# 754 -> "12 min 34 s"
duration()
{
    if (($1 < 60)); then
        printf '%d s' "$1"
    else
        printf '%d min %d s' $(($1 / 60)) $(($1 % 60))
    fi
}

# Memory that may still be used, in MiB: that of the machine or, in a container, what its limit leaves.
available_memory()
{
    local available limit used
    available=$(($(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo) / 1024))
    if [[ -r /sys/fs/cgroup/memory.max ]]; then
        read -r limit </sys/fs/cgroup/memory.max
        read -r used </sys/fs/cgroup/memory.current
        if [[ $limit != max ]] && (((limit - used) / 1048576 < available)); then
            available=$(((limit - used) / 1048576))
        fi
    fi
    printf '%d\n' "$available"
}

# Compile jobs: one per core, but no more than memory holds. The largest files (Eigen, OMPL and Ceres in one) need up to
# 1.5 GB each; swapping would cost more than an idle core. PARKING_JOBS in the environment overrules both.
compile_jobs()
{
    local cores memory
    cores=$(nproc)
    memory=$(($(available_memory) / 1536))
    if [[ -n ${PARKING_JOBS:-} ]]; then
        [[ $PARKING_JOBS =~ ^[1-9][0-9]*$ ]] || die "PARKING_JOBS is '$PARKING_JOBS', expected a number of jobs, 1 or more"
        printf '%d\n' "$PARKING_JOBS"
    elif ((memory < 1)); then
        printf '1\n'
    elif ((memory < cores)); then
        printf '%d\n' "$memory"
    else
        printf '%d\n' "$cores"
    fi
}
