#!/usr/bin/env bash
# `analyse` prints a table and writes JSON that other programs read; its shares are those of `run`; every
# mistake is one line.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"

number_in() {  # FILE PYTHON-EXPRESSION over the JSON document d
    python3 -c "import json, sys; d = json.load(open(sys.argv[1])); print($2)" "$1" 2>&1
}

small_map -o map.h5 >out.txt 2>&1 || fail "a map is computed" "$(cat out.txt)"
claim_exit "a map is analysed" 0 hopscotch analyse map.h5
claim_contains "over parameters shocks are told slice by slice" "slice by slice" out.txt
claim_contains "the basins are named" "fixed point 1" out.txt
claim_contains "the table holds the whole map's metrics" "uncertainty exponent" out.txt
claim_contains "it says in which unit lengths are" "mass_ratio in ln(value)" out.txt
claim_equal "the file written is named" "map_analysis.json" "$(tail -1 out.txt)"
claim_equal "all cells have a class or none" "10800" \
    "$(number_in map_analysis.json 'd["decided"] + d["undecided"] + d["outside_domain"] + d["not_computed"]')"
claim_equal "shares sum to 1" "True" \
    "$(number_in map_analysis.json 'abs(sum(c["share"]["share"] for c in d["classes"]) - 1) < 1e-12')"
run_cells=$(number_in map.json '[row["cells"] for row in d["labels"] if row["value"] > 0]')
claim_equal "basins have the cells that run counted" "$run_cells" \
    "$(number_in map_analysis.json '[c["share"]["cells"] for c in d["classes"] if c["label"]]')"
claim_equal "over a parameter there is no critical shock of the whole map" "[False]" \
    "$(number_in map_analysis.json 'list({s["defined"] for s in d["critical_shocks"]})')"
# alpha*_1 = 4.4934 attracts from above only: the first start below it belongs to another basin
claim_equal "but one in every slice" "True" "$(number_in map_analysis.json \
    '{r["mass_ratio"] for r in d["critical_shocks_over_parameters"]}.__len__() == 90')"
claim_equal "next to lossless hops, which attract from above only" "True" "$(number_in map_analysis.json \
    'all(r["shock"]["in_cells"]["distance"] <= 1 for r in d["critical_shocks_over_parameters"])')"

claim_exit "JSON goes to standard output alone" 0 hopscotch analyse map.h5 -o -
cp out.txt stdout.json
claim_equal "and is the file's" "$(cat map_analysis.json)" "$(cat stdout.json)"
OMP_NUM_THREADS=1 "$program" analyse map.h5 -o one.json >out.txt 2>&1
claim_equal "one thread gives the same bytes" "$(cat map_analysis.json)" "$(cat one.json)"

claim_exit "outcomes are classes on request" 0 hopscotch analyse map.h5 --layer outcome -o outcomes.json
claim_exit "basin stability is taken in a box" 0 \
    hopscotch analyse map.h5 --reference-box liftoff_speed=4:6 --box 3 -o box.json
claim_contains "and printed" "basin stability in the reference box" out.txt
claim_equal "in boxes of the size asked for" "3" "$(number_in box.json 'd["entropy"]["box"]')"

# one state axis: the attractors' points lie in the map
claim_exit "a map of one state column is computed" 0 hopscotch run \
    "$source_folder/configs/scenes/chatterjee2002_fig5a.toml" question.kind=basins question.returns=2000 \
    output.layers='["label", "outcome"]' grid.axis.0.cells=600 --quiet -o line.h5
claim_exit "and analysed" 0 hopscotch analyse line.h5
claim_equal "attractors in the map have a critical shock" "True" \
    "$(number_in line_analysis.json 'any(s["defined"] for s in d["critical_shocks"])')"
claim_equal "and reach to both sides" "True" \
    "$(number_in line_analysis.json 'all(len(s["extents"]) == 1 for s in d["critical_shocks"] if s["defined"])')"

claim_exit "an unknown layer is the store's" 4 hopscotch analyse map.h5 --layer lable
claim_contains "with those there are" "one of label, outcome" err.txt
claim_exit "a box larger than the map is refused" 4 hopscotch analyse map.h5 --box 1000
claim_exit "a reference box that is none is usage" 2 hopscotch analyse map.h5 --reference-box speed
claim_exit "a reference box along no axis is refused" 4 hopscotch analyse map.h5 --reference-box speed=0:1
claim_exit "a rule for falls that is none is usage" 2 hopscotch analyse map.h5 --falls never
claim_exit "a map that is not there is the store's" 4 hopscotch analyse none.h5
claim_equal "and nothing is written for it" "" "$(ls none_analysis.json 2>/dev/null)"
exit $failed
