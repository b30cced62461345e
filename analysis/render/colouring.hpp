// How numbers become colours, and how the picture explains it: a legend of names, or a colour bar.
#pragma once

#include "analysis/render/canvas.hpp"
#include "analysis/render/image_data.hpp"

#include <map>
#include <string>
#include <vector>

namespace hopscotch::picture {

struct legend_entry {
    rgb colour;
    std::string name;
    double share = -1.0;  // of all cells; negative: not said
};

class colouring {
public:
    /// Names for categorical layers (flags, or few different integers), a scale else.
    colouring(const image_data& data, const std::vector<attractor_row>& attractors);

    rgb of(double value) const;

    bool is_categorical() const { return is_categorical_; }
    const std::vector<legend_entry>& legend() const { return legend_; }

    // The scale of a numeric layer.
    double lowest() const { return lowest_; }
    double highest() const { return highest_; }
    bool is_log() const { return is_log_; }
    bool has_cells_below() const { return has_cells_below_; }
    bool has_cells_above() const { return has_cells_above_; }
    bool has_empty_cells() const { return has_empty_cells_; }

private:
    void name_values(const image_data& data, const std::map<int, double>& shares,
                     const std::vector<attractor_row>& attractors);
    void choose_scale(const image_data& data);

    double fill_ = 0.0;
    bool is_categorical_ = false;
    std::map<int, rgb> colours_;
    std::vector<legend_entry> legend_;
    double lowest_ = 0.0;
    double highest_ = 1.0;
    bool is_log_ = false;
    bool is_diverging_ = false;
    bool has_cells_below_ = false;
    bool has_cells_above_ = false;
    bool has_empty_cells_ = false;
};

}  // namespace hopscotch::picture
