// Rows through the return map: which values a row is made of, how rows are grouped and put back in
// order, what is printed, and what is said of bad rows.
#include "host/cli/evaluate.hpp"
#include "host/cli/trace_writer.hpp"
#include "host/scene/error.hpp"
#include "tests/host/fake_model.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

using namespace hopscotch;

namespace {

row_source source(std::string_view text, const std::vector<std::string>& sets = {},
                  int section = 0) {
    return row_source(fake::entry, section, parse_csv(text, "rows.csv"), sets);
}

std::vector<std::string> lines_of(std::string_view text, const std::vector<std::string>& sets = {},
                                  const evaluation& what = {}) {
    return evaluate(source(text, sets), what);
}

std::string message_of(std::string_view text, const std::vector<std::string>& sets = {}) {
    try {
        lines_of(text, sets);
    } catch (const scene_error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST(eval, prints_every_column_of_the_contract) {
    evaluation what;
    what.returns = 3;
    EXPECT_EQ(output_header(source("height,speed\n"), what),
              "row,outcome,returns,events,time,height,speed,bounces");
    EXPECT_EQ(lines_of("height,speed\n8,1\n", {}, what),
              std::vector<std::string>{"0,ok,3,6,0.75,1,4,3"});
}

TEST(eval, keeps_the_order_of_rows_whatever_their_options_and_batches) {
    std::string text = "height,speed,law,gain\n";
    for (int i = 0; i < 10000; ++i) {
        text += fmt::format("{},0,{},{}\n", i % 500, i % 3 == 0 ? "steep" : "plain",
                            i % 2 == 0 ? 0.5 : 1.0);
    }
    const std::vector<std::string> lines = lines_of(text);
    ASSERT_EQ(lines.size(), 10000u);
    for (int i = 0; i < 10000; ++i) {
        const double height = (i % 500) * (i % 2 == 0 ? 0.5 : 1.0);
        EXPECT_EQ(lines[static_cast<std::size_t>(i)],
                  fmt::format("{},ok,1,2,0.25,{:.17g},1,1", i, height));
    }
}

TEST(eval, takes_common_values_from_set_and_the_rest_from_defaults) {
    EXPECT_EQ(lines_of("height\n8\n", {"speed=2", "gain=0.25"}),
              std::vector<std::string>{"0,ok,1,2,0.25,2,3,1"});
}

TEST(eval, leaves_cells_empty_where_there_is_no_state) {
    EXPECT_EQ(lines_of("height,speed\n-1,0\n"),
              std::vector<std::string>{"0,invalid_start,0,0,0,,,0"});
}

TEST(eval, a_section_that_only_starts_orbits_prints_the_columns_it_returns_to) {
    const row_source rows = source("angle\n4\n", {}, 1);
    EXPECT_EQ(output_header(rows, {}), "row,outcome,returns,events,time,height,speed,bounces");
    EXPECT_EQ(evaluate(rows, {}), std::vector<std::string>{"0,ok,1,2,0.25,2,1,1"});
}

TEST(eval, hands_every_digit_to_higher_precision) {
    evaluation what;
    what.precision = precision::dd;
    EXPECT_EQ(lines_of("height,speed\n0.10000000000000000000000001,+1e0\n", {}, what),
              std::vector<std::string>{"0,ok,1,2,0.25,H0.10000000000000000000000001,S,G0.5"});
}

TEST(eval, names_derivatives_by_both_columns_and_leaves_undefined_ones_empty) {
    evaluation what;
    what.has_derivative = true;
    EXPECT_EQ(output_header(source("height,speed\n"), what),
              "row,outcome,returns,events,time,height,speed,bounces,d(height)_d(height),d(height)_"
              "d(speed),"
              "d(speed)_d(height),d(speed)_d(speed)");
    EXPECT_EQ(lines_of("height,speed\n1,1\n", {}, what),
              std::vector<std::string>{"0,ok,1,2,0.25,H1,S,G0.5,1,0,0,"});
}

TEST(eval, infinity_is_legal_where_the_model_allows_it) {
    EXPECT_EQ(message_of("height,speed,mass_ratio\n1,0,inf\n"), "no error");
    EXPECT_EQ(message_of("height,speed,offset\n1,0,inf\n"),
              "rows.csv:2: row 0, offset = inf (outside (-inf, inf))");
    EXPECT_EQ(message_of("height,speed\ninf,0\n"),
              "rows.csv:2: row 0, height = inf (outside [0, inf))");
}

TEST(eval, a_bad_row_is_named_with_its_column) {
    EXPECT_EQ(message_of("height,speed,gain\n1,0,1\n1,0,9\n"),
              "rows.csv:3: row 1, gain = 9 (outside (0, 8])");
    EXPECT_EQ(message_of("height,speed\n1,zero\n"),
              "rows.csv:2: row 0, speed = zero (not a number); a decimal such as 0.25?");
    EXPECT_EQ(message_of("height,speed\n1,\n"),
              "rows.csv:2: row 0, speed (an empty field); a decimal such as 0.25?");
    EXPECT_EQ(message_of("height,speed\n1,nan\n"),
              "rows.csv:2: row 0, speed = nan (not a number); a decimal such as 0.25?");
    EXPECT_EQ(message_of("height,speed,law\n1,0,steap\n"),
              "rows.csv:2: row 0, law = steap (no such choice); steep?");
    EXPECT_EQ(message_of("height,speed,law,gain\n1,0,plain,3\n1,0,steep,3\n"),
              "rows.csv:3: row 1 (the steep law needs gain <= 2)");
}

TEST(eval, a_bad_header_is_named_with_a_suggestion) {
    EXPECT_EQ(message_of("hieght,speed\n1,0\n"),
              "rows.csv:1: header, hieght (no state column of section "
              "apex, parameter or option of fake_bouncer); height?");
    EXPECT_EQ(message_of("height\n1\n"),
              "rows.csv:1: speed (missing: state column of section apex); a "
              "column of that name or --set speed=...?");
    EXPECT_EQ(message_of("height,speed\n1,0\n", {"speed=1"}),
              "rows.csv:1: header, speed (set by --set as well); remove one of them?");
    EXPECT_EQ(message_of("height,speed\n1,0\n", {"gian=1"}),
              "command line: --set gian (no state column of section apex, parameter or option of "
              "fake_bouncer); gain?");
    EXPECT_EQ(message_of("height,speed\n1,0\n", {"gain"}),
              "command line: --set gain (needs name=value)");
}

TEST(trace, writes_samples_events_and_the_end) {
    const std::vector<std::string> texts{"1", "2"};
    const std::vector<std::string> parameters{"0.5", "0", "1"};
    const int options[1]{0};
    orbit_row row;
    row.options = options;
    row.columns = texts;
    row.parameters = parameters;
    EXPECT_EQ(
        trace_text(fake::entry, row, 2, trace_format::csv),
        "record,time,name,mode_left,mode_entered,height,speed,before_height,before_speed,loss\n"
        "sample,0,,flight,flight,1,2,,,\n"
        "sample,0.25,,flight,flight,1.25,2,,,\n"
        "event,0.25,impact,flight,ground,0.5,2,1,2,0.125\n"
        "sample,0.25,,ground,ground,1,2,,,\n"
        "end,0.25,ok,,,,,,,\n");
    EXPECT_EQ(
        trace_text(fake::entry, row, 0, trace_format::jsonl),
        "{\"record\": \"event\", \"time\": 0.25, \"name\": \"impact\", \"mode_left\": \"flight\", "
        "\"mode_entered\": \"ground\", \"before\": {\"height\": 1, \"speed\": 2}, \"after\": "
        "{\"height\": 0.5, \"speed\": 2}, \"loss\": 0.125}\n"
        "{\"record\": \"end\", \"time\": 0.25, \"name\": \"ok\"}\n");
}
