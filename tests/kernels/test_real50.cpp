// The 50-digit arithmetic itself, against decimals from an independent implementation (mpmath, 60
// digits), and decimal numerals going in and out of every host arithmetic.
#include "analysis/truth/decimal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hopscotch::inline HOPSCOTCH_TARGET {
namespace {

using wide = double_double<double>;

void expect_fifty_digits(const real50& got, const char* want) {
    const real50 truth{std::string(want)};
    EXPECT_LT(abs(got / truth - 1.0), real50(1e-50))
        << to_string(got, 55) << " instead of " << want;
}

TEST(real50, elementary_functions_have_fifty_digits) {
    expect_fifty_digits(sin(real50(0.5)),
                        "0.479425538604203000273287935215571388081803367940600675188617");
    expect_fifty_digits(sin(real50(1e12)),
                        "-0.611238702376889498192020415324630566496241705593415903193970");
    expect_fifty_digits(cos(real50(0.5)),
                        "0.877582561890372716116281582603829651991645197109744052997611");
    expect_fifty_digits(cos(real50(1e12)),
                        "0.791446301852890270053766214114332303986760307437186659439099");
    expect_fifty_digits(tan(real50(0.5)),
                        "0.546302489843790513255179465780285383297551720179791246164091");
    expect_fifty_digits(tan(real50(1e12)),
                        "-0.772305968131876141610634944714237460384448825060770577875585");
    expect_fifty_digits(
        cos(real50(0x1.921fb54442d18p+0)),
        "0.0000000000000000612323399573676588613032966137500146464037779883628305209605");
    expect_fifty_digits(exp(real50(-0.75)),
                        "0.472366552741014707138046550943267912970203579136476682395658");
    expect_fifty_digits(exp(real50(300.0)),
                        "1.94242639524125593658420883601769921936620862195160469414292e+130");
    expect_fifty_digits(
        expm1(real50(0x1.0000000000000p-40)),
        "0.000000000000909494701773341828221315701723499792085211988333002149166553");
    expect_fifty_digits(log(real50(3.0)),
                        "1.09861228866810969139524523692252570464749055782274945173469");
    expect_fifty_digits(
        log1p(real50(0x1.0000000000000p-40)),
        "0.000000000000909494701772514647608762799434692470904243110457902306976190");
    expect_fifty_digits(atan(real50(3.0)),
                        "1.24904577239825442582991707728109012307782940412989671905467");
    expect_fifty_digits(asin(real50(0.75)),
                        "0.848062078981481008052944338998418080073366213263112642860718");
    expect_fifty_digits(acos(real50(-0.75)),
                        "2.41885840577637762728426603063816952217195091295066555334819");
    expect_fifty_digits(sinh(real50(0x1.0000000000000p-20)),
                        "0.000000953674316406394560289664740498375203882023391455637337754019");
    expect_fifty_digits(sinh(real50(3.0)),
                        "10.0178749274099018989745936194658280601781041231828634644057");
    expect_fifty_digits(cosh(real50(3.0)),
                        "10.0676619957777658419539360351158898368098037153712866799733");
    expect_fifty_digits(tanh(real50(0.25)),
                        "0.244918662403709129277801131491016957506558730617820326118874");
    expect_fifty_digits(asinh(real50(0x1.0000000000000p-20)),
                        "0.000000953674316406105439710335325240033564503739734466904869850684");
    expect_fifty_digits(asinh(real50(3.0)),
                        "1.81844645923206682348369896356070899378625394276812161745174");
    expect_fifty_digits(atanh(real50(0.25)),
                        "0.255412811882995341602757048151830967439055398222884135088977");
    expect_fifty_digits(cbrt(real50(5.0)),
                        "1.70997594667669698935310887254386010986805511054305492438286");
    expect_fifty_digits(sqrt(real50(5.0)),
                        "2.23606797749978969640917366873127623544061835961152572427090");
    expect_fifty_digits(atan2(real50(2.0), real50(-3.0)),
                        "2.55359005004222568721703230265441745659546215331918146724890");
    expect_fifty_digits(pi<real50>(),
                        "3.14159265358979323846264338327950288419716939937510582097494");
    expect_fifty_digits(ln2<real50>(),
                        "0.693147180559945309417232121458176568075500134360255254120680");
    expect_fifty_digits(sqrt2<real50>(),
                        "1.41421356237309504880168872420969807856967187537694807317668");
}

TEST(real50, rounds_ties_to_even_and_copies_signs) {
    for (const double x : {-3.5, -2.5, -1.5, -0.5, -0.3, 0.5, 0.7, 1.5, 2.5, 3.5, 7.0}) {
        EXPECT_TRUE(nearest(real50(x)) == real50(std::rint(x))) << x;
        EXPECT_TRUE(floor(real50(x)) == real50(std::floor(x))) << x;
    }
    EXPECT_TRUE(copysign(real50(2.0), real50(-0.0)) == real50(-2.0));
    EXPECT_TRUE(copysign(real50(-2.0), real50(1.0)) == real50(2.0));
}

TEST(real50, comparisons_with_not_a_number_are_false) {
    const real50 nan = not_a_number<real50>();
    EXPECT_FALSE((nan < 1.0) | (nan <= 1.0) | (nan > 1.0) | (nan >= 1.0) | (nan == nan));
}

TEST(decimal, numerals_keep_every_digit_that_the_arithmetic_has) {
    EXPECT_EQ(print_real(parse_real<double>("0.1")), "1.0000000000000001e-01");
    EXPECT_EQ(print_real(parse_real<wide>("0.1")), "1.0000000000000000000000000000000e-01");
    const char* third = "3.3333333333333333333333333333333333333333333333333e-01";
    EXPECT_EQ(print_real(parse_real<real50>(third)), third);
    EXPECT_EQ(print_real(parse_real<real50>("-42")),
              "-4.2000000000000000000000000000000000000000000000000e+01");
}

TEST(decimal, a_double_survives_printing_and_parsing) {
    for (const double x : {0.1, 1.0 / 3.0, 1e300, -2.2250738585072014e-308, 4.9406564584124654e-324,
                           1e-310, 0.0, 1.7976931348623157e308}) {
        EXPECT_EQ(parse_real<double>(print_real(x)), x);
        EXPECT_EQ(to_double(parse_real<real50>(print_real(x))), x);
    }
}

TEST(decimal, a_double_double_survives_printing_and_parsing_to_32_digits) {
    const wide third = wide(1.0) / wide(3.0);
    const wide back = parse_real<wide>(print_real(third));
    EXPECT_LT(to_double(abs(back - third)), 1e-32);
}

TEST(decimal, infinities_and_not_a_number_are_numerals) {
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(parse_real<double>("inf"), inf);
    EXPECT_EQ(parse_real<wide>("-inf").high, -inf);
    EXPECT_EQ(parse_real<wide>("-inf").low, 0.0);
    EXPECT_EQ(print_real(parse_real<real50>("inf")), "inf");
    EXPECT_EQ(print_real(inf), "inf");
    EXPECT_TRUE(std::isnan(parse_real<double>("nan")));
    EXPECT_EQ(parse_real<double>("1e400"), inf);
    EXPECT_EQ(parse_real<double>("1e-400"), 0.0);
}

TEST(decimal, anything_but_a_numeral_is_refused_with_its_text) {
    for (const char* text : {"", " 1", "1 ", "1x", "0x10", "--1", "+1", "one", "1e", "1,5"}) {
        EXPECT_THROW(parse_real<double>(text), std::invalid_argument) << text;
        EXPECT_THROW(parse_real<wide>(text), std::invalid_argument) << text;
        EXPECT_THROW(parse_real<real50>(text), std::invalid_argument) << text;
    }
    try {
        parse_real<double>("1x");
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "\"1x\" is not a decimal number");
    }
}

}  // namespace
}  // namespace hopscotch::inline HOPSCOTCH_TARGET
