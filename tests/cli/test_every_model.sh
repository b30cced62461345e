#!/usr/bin/env bash
# `eval` and `trace` for every model, section and option, and the outcome of every failure, as listed
# in outcomes.txt. What there is to test is read from `models`, so a new model only adds lines there.
source "$(dirname "${BASH_SOURCE[0]}")/claims.sh"
table=$source_folder/tests/cli/outcomes.txt

# rows MODEL [SECTION [OUTCOME]]: lines of the table, without the blanks around the bars
rows() {
    grep -v '^#' "$table" | sed 's/ *| */|/g' |
        awk -F'|' -v m="$1" -v s="${2:-}" -v o="${3:-}" \
            '$1 == m && (s == "" || $2 == s) && (o == "" || $3 == o)'
}
# write_row SETTINGS...: rows.csv with one row, names and values of the settings
write_row() {
    local names="" values="" setting
    for setting in "$@"; do
        names+=,${setting%%=*}
        values+=,${setting#*=}
    done
    printf '%s\n%s\n' "${names#,}" "${values#,}" >rows.csv
}

for model in $(hopscotch models | awk '{print $1}'); do
    hopscotch models "$model" >model.txt
    outcomes=$(grep -A1 '^outcomes' model.txt | tail -1 | tr -d ' ')
    sections=$(sed -n 's/^section \([^:]*\):.*/\1/p' model.txt)
    # NAME CHOICE for every option, and one line without
    choices=$(awk '/^options/ {on = 1; next} /^[a-z]/ {on = 0}
        on {name = $1; print name "=" $2; for (i = 3; $i == "|"; i += 2) print name "=" $(i + 1)}' model.txt)

    for section in $sections; do
        line=$(rows "$model" "$section" ok | head -1)
        if [ -z "$line" ]; then
            fail "every section has a start" "no start of $model on $section in outcomes.txt"
            continue
        fi
        IFS='|' read -r _ _ _ returns settings <<<"$line"
        columns=$(awk -v s="$section:" '$1 == "section" {on = ($2 == s); next} /^[a-z]/ {on = 0}
            on && $1 != "column" {printf ",%s", $1}' model.txt)
        for choice in "" $choices; do
            what="$model $section $choice"
            write_row $settings $choice
            claim_exit "eval: $what" 0 hopscotch eval "$model" --section "$section" \
                --returns "$returns" --input rows.csv --derivative
            claim_equal "header of $what" "row,outcome,returns,events,time" \
                "$(head -1 out.txt | cut -d, -f1-5)"
            ended=$(sed -n 2p out.txt | cut -d, -f2)
            time=$(sed -n 2p out.txt | cut -d, -f5)
            [[ ",$outcomes," == *",$ended,"* ]] || fail "outcome of $what" "'$ended' is not declared"
            [ -n "$choice" ] || claim_equal "$what goes on" ok "$ended"
            if [[ "$(head -1 out.txt)" != *"$columns"* ]] &&
                grep -q "^section $section:" model.txt && [ "$section" != flight ]; then
                fail "columns of $what" "$(head -1 out.txt) lacks $columns"
            fi
            for format in csv jsonl; do
                claim_exit "trace: $what" 0 hopscotch trace "$model" --section "$section" \
                    --returns "$returns" --samples 2 --format $format --set $settings $choice
                tail -1 out.txt >last.txt
                claim_contains "the trace of $what ends as eval" "$ended" last.txt
                claim_contains "and as late" "$time" last.txt
            done
        done
        # 50 digits agree with double on the outcome
        write_row $settings
        hopscotch eval "$model" --section "$section" --input rows.csv --precision mp50 >out.txt
        claim_equal "mp50: $model $section" ok "$(sed -n 2p out.txt | cut -d, -f2)"
    done

    section=$(head -1 <<<"$sections")
    for ended in ${outcomes//,/ }; do
        case $ended in
            unresolved_event) continue ;;  # none is known: it says that an event was not decided
            invalid_start)
                IFS='|' read -r _ _ _ _ settings <<<"$(rows "$model" "$section" ok | head -1)"
                first=${settings%%=*}
                write_row "$first=nan" ${settings#* }
                hopscotch eval "$model" --section "$section" --input rows.csv >out.txt 2>err.txt
                code=$?
                [ $code = 3 ] || claim_equal "no number is no start: $model" invalid_start \
                    "$(sed -n 2p out.txt | cut -d, -f2)"
                continue
                ;;
        esac
        line=$(rows "$model" "" "$ended" | head -1)
        if [ -z "$line" ]; then
            [ "$ended" = budget ] || [ "$ended" = not_finite ] || [ "$ended" = rest ] ||
                fail "every outcome has a start" "$model: no start that ends as $ended"
            continue
        fi
        IFS='|' read -r _ section_of _ returns settings <<<"$line"
        [ "$returns" = never ] && continue
        write_row $settings
        claim_exit "eval that ends as $ended: $model" 0 hopscotch eval "$model" \
            --section "$section_of" --returns "$returns" --input rows.csv
        claim_equal "$model ends as $ended" "$ended" "$(sed -n 2p out.txt | cut -d, -f2)"
        claim_exit "trace that ends as $ended: $model" 0 hopscotch trace "$model" \
            --section "$section_of" --returns "$returns" --set $settings
        tail -1 out.txt >last.txt
        claim_contains "the trace of $model ends as $ended" "$ended" last.txt
    done
done
exit $failed
