# Shared by the tests of the command line: `source claims.sh PROGRAM SOURCE_FOLDER` makes a scratch
# folder, goes there, and offers checks whose first argument is the claim.
program=$1
source_folder=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
failed=0

hopscotch() { "$program" "$@"; }

fail() {  # CLAIM, what happened instead
    echo "FAILED: $1"
    echo "  $2"
    failed=1
}

# claim_exit CLAIM CODE COMMAND...: the exit code, and for errors exactly one line on stderr
claim_exit() {
    local claim=$1 code=$2 got=0
    shift 2
    "$@" >out.txt 2>err.txt || got=$?
    [ "$got" = "$code" ] || fail "$claim" "exit code $got instead of $code: $(cat err.txt)"
    if [ "$code" != 0 ] && [ "$(wc -l <err.txt)" != 1 ]; then
        fail "$claim" "not one line: $(cat err.txt)"
    fi
}

claim_equal() {  # CLAIM EXPECTED GOT
    [ "$2" = "$3" ] || fail "$1" "got '$3' instead of '$2'"
}

claim_contains() {  # CLAIM TEXT FILE
    grep -qF -- "$2" "$3" || fail "$1" "no '$2' in: $(head -c 2000 "$3")"
}

# The map of the quickstart scene, small enough for tests.
small=("$source_folder/configs/scenes/quickstart.toml" grid.axis.0.cells=120 grid.axis.1.cells=90
    "output.tile=[30, 30]" accuracy.audit_cells=20 --quiet)
small_map() { hopscotch run "${small[@]}" "$@"; }
