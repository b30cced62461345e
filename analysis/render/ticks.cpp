#include "analysis/render/ticks.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace hopscotch::picture {

namespace {

std::string formatted(const char* format, int precision, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, precision, value);
    return text;
}

/// Typographic minus and exponents: "-2.5e-07" -> "−2.5×10^{−7}".
std::string typeset(std::string text) {
    const std::size_t e = text.find('e');
    if (e != std::string::npos) {
        const int exponent = std::stoi(text.substr(e + 1));
        const std::string mantissa = text.substr(0, e);
        text =
            (mantissa == "1" ? "" : mantissa + "\u00d7") + "10^{" + std::to_string(exponent) + "}";
    }
    std::string result;
    for (const char c : text) result += c == '-' ? "\u2212" : std::string(1, c);
    return result;
}

double round_step(double rough) {
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
        if (rough <= 1.0001 * factor * power) return factor * power;
    }
    return 10.0 * power;
}

std::string linear_label(double value, double step, double largest) {
    if (std::abs(value) < 1e-9 * step) return "0";
    if (largest >= 1e5 || largest < 1e-3) {
        const int digits = static_cast<int>(std::floor(std::log10(std::abs(value) / step) + 1e-9));
        std::string text = formatted("%.*e", std::max(0, digits + 1), value);
        const std::size_t e = text.find('e');
        std::string mantissa = text.substr(0, e);
        if (mantissa.find('.') != std::string::npos) {
            mantissa.erase(mantissa.find_last_not_of('0') + 1);
            if (mantissa.back() == '.') mantissa.pop_back();
        }
        return typeset(mantissa + text.substr(e));
    }
    int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    const double scaled = step * std::pow(10.0, decimals);
    if (std::abs(scaled - std::round(scaled)) > 1e-6) ++decimals;  // steps of 2.5
    return typeset(formatted("%.*f", decimals, value));
}

}  // namespace

std::vector<tick> linear_ticks(double lowest, double highest, int n) {
    if (!(highest > lowest)) return {{lowest, short_number(lowest)}};
    const double step = round_step((highest - lowest) / std::max(n, 1));
    const double largest = std::max(std::abs(lowest), std::abs(highest));
    std::vector<tick> ticks;
    const double slack = 1e-9 * (highest - lowest);
    for (double i = std::ceil((lowest - slack) / step); i * step <= highest + slack; i += 1.0) {
        ticks.push_back({i * step, linear_label(i * step, step, largest)});
    }
    return ticks;
}

std::vector<tick> log_ticks(double lowest, double highest, int n) {
    const double decades = std::log10(highest / lowest);
    if (!(decades > 0.0) || decades < 0.7) return linear_ticks(lowest, highest, n);
    const int first = static_cast<int>(std::floor(std::log10(lowest) + 1e-9));
    const int last = static_cast<int>(std::ceil(std::log10(highest) - 1e-9));
    const int every = std::max(1, static_cast<int>(std::ceil(decades / n)));
    const bool is_plain = first >= -3 && last <= 4;
    std::vector<tick> ticks;
    for (int power = first; power <= last; ++power) {
        for (int digit = 1; digit < 10; ++digit) {
            const double value = digit * std::pow(10.0, power);
            if (value < lowest * (1.0 - 1e-9) || value > highest * (1.0 + 1e-9)) continue;
            const bool is_labelled = digit == 1 ? (power - first) % every == 0
                                                : decades < 2.0 && (digit == 2 || digit == 5);
            if (digit > 1 && every > 1) continue;
            std::string label;
            if (is_labelled) {
                label = is_plain ? typeset(formatted("%.*g", 6, value))
                                 : typeset(std::to_string(digit) + "e" + std::to_string(power));
            }
            ticks.push_back({value, label});
        }
    }
    return ticks;
}

std::string axis_title(std::string_view name, std::string_view unit) {
    std::string title(name);
    std::replace(title.begin(), title.end(), '_', ' ');
    if (unit.empty() || unit == "1") return title;
    title += " (";
    for (std::size_t i = 0; i < unit.size(); ++i) {
        const bool is_exponent = i > 0 &&
                                 std::isalpha(static_cast<unsigned char>(unit[i - 1])) != 0 &&
                                 (std::isdigit(static_cast<unsigned char>(unit[i])) != 0 ||
                                  (unit[i] == '-' && i + 1 < unit.size() &&
                                   std::isdigit(static_cast<unsigned char>(unit[i + 1])) != 0));
        if (unit[i] == '^') continue;
        const bool follows_hat = i > 0 && unit[i - 1] == '^';
        if (!is_exponent && !follows_hat) {
            title += unit[i];
            continue;
        }
        title += "^{";
        do {
            title += unit[i] == '-' ? "\u2212" : std::string(1, unit[i]);
            ++i;
        } while (i < unit.size() && std::isdigit(static_cast<unsigned char>(unit[i])) != 0);
        --i;
        title += "}";
    }
    return title + ")";
}

std::string short_number(double value) { return typeset(formatted("%.*g", 4, value)); }

}  // namespace hopscotch::picture
