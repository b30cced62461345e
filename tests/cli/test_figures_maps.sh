#!/usr/bin/env bash
# Scenes of published figures answer with the printed numbers: their maps.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
/usr/bin/python3 "$source_folder/tests/cli/figures.py" "$program" "$source_folder" maps
exit
