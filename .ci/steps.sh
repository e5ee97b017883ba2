# What .ci/run and .ci/world share: sourced by both, at the root of the clone.

TOOLS="$PWD/.tools"
done_so_far=()

step() {
    printf '\n==> %s\n' "$*"
}

passed() {
    done_so_far+=("$* (${SECONDS} s)")
}

try() {
    step "$@"
    "$@"
    passed "$@"
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

# Debian splits Python up, and its smallest images lack make and git.
install_what_is_missing() {
    local missing=()
    command -v make >/dev/null || missing+=(make)
    command -v git >/dev/null || missing+=(git)
    if ! command -v python3 >/dev/null; then
        missing+=(python3 python3-venv)
    elif ! python3 -c 'import ensurepip, venv' 2>/dev/null; then
        missing+=(python3-venv)
    fi
    # The reference is tested in a real browser, and its scripts under Node.js.
    command -v chromium >/dev/null || missing+=(chromium fonts-dejavu-core)
    command -v npm >/dev/null || missing+=(npm)
    # A codec in C is held to the spec.
    command -v cc >/dev/null || missing+=(gcc libc6-dev)
    [ ${#missing[@]} -eq 0 ] && return
    command -v apt-get >/dev/null || { echo "please install: ${missing[*]}" >&2; exit 1; }
    as_root apt-get update -qq
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq "${missing[@]}"
}

# Goes on in an empty environment, as the script of that name, once the machine has what it needs.
begin_anew() {
    [ -z "${BEGUN_ANEW+set}" ] || return 0
    step "What the machine needs"
    install_what_is_missing
    echo "nothing is missing"
    exec .ci/bare env BEGUN_ANEW=true bash "$@"
}

all_is_well() {
    step "All is well"
    printf '    %s\n' "${done_so_far[@]}"
}
