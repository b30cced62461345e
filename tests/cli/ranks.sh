# Shared by the tests with several ranks: `source ranks.sh` after claims.sh. Leaves with 77 ("skipped")
# where there is no mpirun or the program is built without MPI.
command -v mpirun >/dev/null || { echo "skipped: no mpirun (openmpi-bin)"; exit 77; }
"$program" version | grep -q 'built without MPI' && { echo "skipped: built without MPI"; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_orte_abort_print_stack=0

ranks() {  # N ARGUMENTS...: the program by N ranks
    local n=$1
    shift
    mpirun --quiet -n "$n" "$program" "$@"
}

hash_of() { grep '"hash"' "$1" | cut -d'"' -f4; }

n_tiles_in() { find "$1" -name 'tile_*.h5' 2>/dev/null | wc -l; }

wait_for_tiles() {  # FOLDER N: until more than N tiles are there
    for _ in $(seq 3000); do  # long for a busy machine
        [ "$(n_tiles_in "$1")" -gt "$2" ] && return
        sleep 0.02
    done
    fail "tiles appear in $1" "$(n_tiles_in "$1") after a minute"
}

# processes of the program that the launcher MPIRUN (its process) has started
ranks_of() { pgrep -P "$1" -x hopscotch; }
