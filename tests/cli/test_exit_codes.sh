#!/usr/bin/env bash
# Every kind of mistake has its exit code and one line that says what to do instead.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
scene=$source_folder/configs/scenes/quickstart.toml

claim_exit "version and models answer" 0 hopscotch version
claim_exit "the list of models answers" 0 hopscotch models
claim_exit "help is no mistake" 0 hopscotch run --help

claim_exit "no command is usage" 2 hopscotch
claim_exit "a misspelt command is usage" 2 hopscotch rnu "$scene"
claim_contains "and the closest command is named" "run?" err.txt
claim_exit "a misspelt option is usage" 2 hopscotch run "$scene" --thread 2
claim_contains "and the closest option is named" "--threads?" err.txt
claim_exit "an unknown model is usage" 2 hopscotch models passive_hoper
claim_contains "and the closest model is named" "passive_hopper?" err.txt
claim_exit "benchmarks are not in the program" 2 hopscotch bench return_map
claim_contains "and it is told where they are" "./hopscotch bench in a checkout?" err.txt
claim_exit "a walltime that is none is usage" 2 hopscotch run "$scene" --walltime soon

claim_exit "a missing scene is bad input" 3 hopscotch run none.toml
claim_exit "a bad override is bad input" 3 hopscotch run "$scene" grid.axis.0.cells=0
claim_contains "and it is reported as the command line" \
    "command line: grid.axis[0].cells = 0 (an axis needs at least one cell); remove the axis" err.txt
sed 's/^returns = .*/retruns = 5/' "$scene" >bad.toml
line=$(grep -n '^retruns' bad.toml | cut -d: -f1)
claim_exit "a misspelt key is bad input" 3 hopscotch run bad.toml
claim_contains "and it is named with file, line and suggestion" \
    "bad.toml:$line: question.retruns = 5 (unknown key of the question basins); returns?" err.txt

echo "no map" >text.h5
claim_exit "a file that is no map is the store's" 4 hopscotch info text.h5
claim_exit "a file that is not there is the store's" 4 hopscotch verify none.h5
export CUDA_VISIBLE_DEVICES=  # hides a GPU, where there is one
claim_exit "a backend that is not there is the device's" 5 hopscotch run "$scene" --backend cuda
claim_contains "and it is told what can be had" "--backend auto?" err.txt
claim_exit "no time left is resumable" 75 hopscotch run "$scene" -o late.h5 --walltime 0:00:00 --quiet
claim_equal "and nothing is left behind" "" "$(ls -d late* 2>/dev/null)"
exit $failed
