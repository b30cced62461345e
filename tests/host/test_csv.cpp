// Tables of starts: what is read, and what is said where a file is malformed.
#include "host/cli/csv.hpp"
#include "host/cli/decimal.hpp"
#include "host/scene/error.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace hopscotch;

namespace {

std::string message_of(std::string_view text) {
    try {
        parse_csv(text, "rows.csv");
    } catch (const scene_error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST(csv, reads_header_and_rows) {
    const csv_table table = parse_csv("height, speed\n1,2\n 3 ,\t4\n", "rows.csv");
    EXPECT_EQ(table.header, (std::vector<std::string_view>{"height", "speed"}));
    ASSERT_EQ(table.n_rows(), 2u);
    EXPECT_EQ(table.at(1, 0), "3");
    EXPECT_EQ(table.at(1, 1), "4");
    EXPECT_EQ(table.place(1), "rows.csv:3");
}

TEST(csv, takes_what_spreadsheets_write) {
    const csv_table table =
        parse_csv("\xef\xbb\xbf\"height\",\"law\"\r\n\"1.5\",\"a,b\"\r\n\r\n", "rows.csv");
    EXPECT_EQ(table.header[0], "height");
    ASSERT_EQ(table.n_rows(), 1u);
    EXPECT_EQ(table.at(0, 0), "1.5");
    EXPECT_EQ(table.at(0, 1), "a,b");
}

TEST(csv, a_header_alone_is_a_table_without_rows) {
    EXPECT_EQ(parse_csv("height", "rows.csv").n_rows(), 0u);
}

TEST(csv, survives_being_moved) {
    csv_table first = parse_csv("a\n1\n", "x");
    const csv_table second = std::move(first);
    EXPECT_EQ(second.at(0, 0), "1");
}

TEST(csv, names_line_and_row_of_what_is_malformed) {
    EXPECT_EQ(message_of(""),
              "rows.csv:1: header (the file is empty); a first line with the names of the "
              "columns?");
    EXPECT_EQ(message_of("a,b\n1,2\n3\n"), "rows.csv:3: row 1 (1 fields where the header has 2)");
    EXPECT_EQ(message_of("a,b\n1,2,3\n"), "rows.csv:2: row 0 (3 fields where the header has 2)");
    EXPECT_EQ(message_of("a,b\n\n1,2\n"), "rows.csv:2: row 0 (an empty line between rows)");
    EXPECT_EQ(message_of("a,,b\n"), "rows.csv:1: header, column 1 (it has no name)");
    EXPECT_EQ(message_of("a,b,a\n"), "rows.csv:1: header = a (the name stands there twice)");
    EXPECT_EQ(message_of("a\n\"1\n"), "rows.csv:2: a quote (it is not closed)");
}

TEST(decimals, are_rounded_to_the_nearest_double_whatever_their_length) {
    EXPECT_EQ(parse_decimal("0.1"), 0.1);
    EXPECT_EQ(parse_decimal("+2.5e-3"), 2.5e-3);
    EXPECT_EQ(parse_decimal("1e23"), 1e23);
    // one ulp above 1 begins at 1 + 2^-53, a tie; the digit behind it decides
    const std::string tie = "1.00000000000000011102230246251565404236316680908203125";
    EXPECT_EQ(parse_decimal(tie), 1.0);
    EXPECT_EQ(parse_decimal(tie + std::string(1000, '0') + "1"), 1.0 + 0x1p-52);
}

TEST(decimals, beyond_the_range_of_doubles_are_infinite_or_zero) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(parse_decimal("1e400"), infinite);
    EXPECT_EQ(parse_decimal("-1e400"), -infinite);
    EXPECT_EQ(parse_decimal("1e-400"), 0.0);
    EXPECT_EQ(parse_decimal("0." + std::string(400, '0') + "1"), 0.0);
    EXPECT_EQ(parse_decimal("1" + std::string(400, '0')), infinite);
    EXPECT_EQ(parse_decimal("1" + std::string(400, '0') + "e-400"), 1.0);
    EXPECT_EQ(parse_decimal("4.9e-324"), std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(parse_decimal("inf"), infinite);
    EXPECT_EQ(parse_decimal("-inf"), -infinite);
}

TEST(decimals, nothing_else_is_a_number) {
    for (const char* text : {"", "abc", "1,5", "0x10", "1.5m", "nan", "--1", "+-1", "1e", " 1"}) {
        EXPECT_FALSE(parse_decimal(text)) << text;
    }
}
