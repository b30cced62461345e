#!/usr/bin/env bash
# `eval` prints the contract's columns, is the same on every backend, and writes whole files or none.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"

printf 'liftoff_speed,mass_ratio\n3,inf\n5,1\n4.6,0.05\n-1,1\n' >rows.csv
eval_rows() { hopscotch eval passive_hopper --section liftoff --returns 2 --input rows.csv "$@"; }

claim_exit "rows are evaluated" 0 eval_rows --output plain.csv
claim_equal "the header is the contract's" "row,outcome,returns,events,time,liftoff_speed,bounces,loss" \
    "$(head -1 plain.csv)"
claim_equal "an infinite mass ratio conserves the speed" "3" "$(sed -n 2p plain.csv | cut -d, -f6)"
claim_equal "an invalid start is an outcome with empty cells" "3,invalid_start,0,0,0,,0,0" \
    "$(sed -n 5p plain.csv)"
for backend in scalar avx2 avx512; do
    eval_rows --backend $backend --output $backend.csv 2>err.txt
    code=$?
    [ $code = 5 ] && continue  # this processor has it not
    claim_equal "$backend gives the same bytes" "$(cat plain.csv)" "$(cat $backend.csv)"
done

claim_exit "higher precision is evaluated" 0 eval_rows --precision mp50 --derivative
claim_contains "derivatives are named by both columns" "d(liftoff_speed)_d(liftoff_speed)" out.txt
printf 'liftoff_speed\n5\n' >one.csv
claim_exit "the first digits of 50 are those of double" 0 \
    hopscotch eval passive_hopper --input one.csv --precision mp50
# f(5) at mass ratio 1 to ten digits
claim_contains "and right" ",3.346152819" out.txt

printf 'liftoff_speed,mass_ratio\n3,1\n3,-1\n' >bad.csv
claim_exit "a bad row is bad input" 3 hopscotch eval passive_hopper --input bad.csv --output never.csv
claim_contains "and it is named with line, row and column" \
    "bad.csv:3: row 1, mass_ratio = -1 (outside (0, inf])" err.txt
claim_equal "and nothing is written" "" "$(ls never.csv* 2>/dev/null)"
claim_exit "text among the numbers is bad input" 3 \
    hopscotch eval passive_hopper --input <(printf 'liftoff_speed\nfast\n')
claim_contains "and the field is named" "row 0, liftoff_speed = fast (not a number)" err.txt
printf 'liftof_speed\n1\n' >typo.csv
claim_exit "a misspelt column is bad input" 3 hopscotch eval passive_hopper --input typo.csv
claim_contains "and the closest one is named" "liftoff_speed?" err.txt

claim_exit "a trace is written" 0 hopscotch trace passive_hopper --set liftoff_speed=5 --samples 2
claim_contains "with its events" "event," out.txt
claim_equal "and its end" "end" "$(tail -1 out.txt | cut -d, -f1)"
claim_exit "a trace as JSON lines is written" 0 \
    hopscotch trace passive_hopper --set liftoff_speed=5 --format jsonl

printf 'speed,angle\n5,0.3\n' >runner.csv
run_row() { hopscotch eval slip --input runner.csv "$@"; }
claim_exit "a tolerance is taken" 0 run_row --tolerance 1e-4 --output loose.csv
claim_exit "and so is the default" 0 run_row --output default.csv
run_row --tolerance 1e-10 --output same.csv
claim_equal "which is 1e-10" "$(cat default.csv)" "$(cat same.csv)"
cmp -s loose.csv default.csv && fail "a looser tolerance gives other digits" "the same file"
claim_equal "but the same first ones" "$(tail -1 default.csv | cut -c1-12)" \
    "$(tail -1 loose.csv | cut -c1-12)"
claim_exit "a tolerance beyond the series' reach is a usage error" 2 run_row --tolerance 0.5
claim_exit "a trace takes one too" 0 \
    hopscotch trace slip --set speed=5 --set angle=0.3 --tolerance 1e-6
exit $failed
