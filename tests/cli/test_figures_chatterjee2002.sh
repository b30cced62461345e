#!/usr/bin/env bash
# Scenes of the passive hopper's figures answer with printed numbers and closed forms.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
/usr/bin/python3 -B "$source_folder/tests/cli/figures/chatterjee2002.py" "$program" "$source_folder"
exit
