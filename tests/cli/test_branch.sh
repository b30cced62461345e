#!/usr/bin/env bash
# `branch` prints special points, writes CSV, JSON and pictures, and refuses what it cannot follow in one line.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
scenes=$source_folder/configs/scenes

claim_exit "a cascade is followed" 0 hopscotch branch "$scenes/koditschek1991_cascade_branch.toml" \
    grid.axis.0.cells=3 grid.axis.1.cells=8 question.doublings=3
claim_contains "flips stand in the table" "flip" out.txt
claim_contains "the first one lies at e^2" "7.38905609893" out.txt
claim_contains "four flips give the accumulation point" "accumulation" out.txt
csv=koditschek1991_cascade_branch.csv
claim_equal "the CSV names variable, columns and stability" \
    "branch,period,orbit,point,gain,energy,stable,multiplier_real,multiplier_imaginary,events" \
    "$(head -1 $csv)"
claim_equal "every point of a cycle has a row" "0,1" \
    "$(awk -F, '$2 == 2 && $3 == 5 {print $4}' $csv | paste -sd, -)"
claim_contains "the JSON names the variable" '"variable": "gain"' koditschek1991_cascade_branch.json
claim_equal "the picture is a PNG" "PNG" "$(head -c 4 koditschek1991_cascade_branch.png | tail -c 3)"

claim_exit "a second variable gives curves" 0 hopscotch branch "$scenes/schaal1993_curves.toml" \
    grid.axis.0.cells=2 question.step=0.05 -o paddle
claim_contains "curves have a table of their own" "curve" out.txt
claim_equal "and a CSV" "curve,kind,period,amplitude,restitution,phase,relative_velocity" \
    "$(head -1 paddle_curves.csv)"

claim_exit "a runner's gaits are followed" 0 hopscotch branch "$scenes/ghigliazza2005_fig8a_branch.toml"
claim_equal "with the one speed at which a gap opens (page, section 11)" "9.58613" \
    "$(grep -o '"gaps": .*' ghigliazza2005_fig8a_branch.json | sed -n 's/.*"speed": \([0-9.]*\).*/\1/p' |
        xargs printf '%.5f')"
claim_equal "listed once" 1 "$(grep -c 'gap opens' out.txt)"
claim_contains "and the place of an end with its error" "at 10.60660171779" out.txt
claim_contains "in the JSON too" '"located": {"speed": 10.60660171779' ghigliazza2005_fig8a_branch.json

claim_exit "gaits with gravity in stance are followed" 0 hopscotch branch \
    "$scenes/ghigliazza2005_gravity_branch.toml"
claim_equal "with the gap of the page's table" "8.4781" \
    "$(grep 'gap opens' out.txt | awk '{print $3}' | xargs printf '%.4f')"

claim_exit "another question is refused" 3 hopscotch branch "$scenes/quickstart.toml"
claim_contains "with the kind that is answered" '"branch"?' err.txt
cat >angle.toml <<'TOML'
[model]
name = "slip"
[model.options]
stance_gravity = "off"
[grid]
section = "touchdown"
[[grid.axis]]
name = "angle"
min = 0.1
max = 0.4
cells = 4
[start]
speed = 5.0
[question]
kind = "branch"
TOML
claim_exit "a column that returns change is no variable" 3 hopscotch branch angle.toml
claim_contains "and the message says so" "conserves" err.txt
claim_exit "a misspelt number is refused" 3 hopscotch branch "$scenes/cham2007_fig6_branch.toml" \
    question.doubling=1
claim_contains "with the name that was meant" "doublings" err.txt
claim_exit "run does not answer it" 3 hopscotch run "$scenes/cham2007_fig6_branch.toml"
exit $failed
