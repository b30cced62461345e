#!/usr/bin/env bash
# Scenes of the runner's figures with gravity in stance and pitching answer with printed numbers and closed forms.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
/usr/bin/python3 -B "$source_folder/tests/cli/figures/ghigliazza2005_gravity.py" "$program" "$source_folder"
exit
