#!/usr/bin/env bash
# Thirty kills at random moments (slow_kills.sh: a thousand).
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
source "$source_folder/tests/cli/kills.sh"
kill_runs 30
exit $failed
