#!/usr/bin/env bash
# A thousand kills at random moments.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
source "$source_folder/tests/cli/kills.sh"
kill_runs 1000
exit $failed
