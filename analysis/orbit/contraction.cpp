// Contraction over an ellipsoid: one enclosure where it is small, else over cubes that cover it.
#include "analysis/orbit/contraction.hpp"

#include "analysis/truth/interval_matrix.hpp"

#include <cmath>
#include <vector>

namespace hopscotch {
namespace {

constexpr double rounding_room = 0x1p-40;  // of the kernels, relative to a state's size
constexpr double loosest_frame = 1e-6;     // how far A B may be from the identity

/// A cube of starts in the coordinates v, or the whole ball.
struct piece {
    double from[most_columns] = {};
    double half = 0.0;
    bool is_ball = false;
};

/// The ellipsoid's own coordinates: x = c + B v with B about A^-1, over the columns not held fixed.
struct frame_of_trap {
    std::vector<int> free;  // columns that A looks at
    small_matrix shape;     // A over them
    small_matrix inverse;   // B
    double radius = 1.0;    // the ball |v| <= radius holds the ellipsoid
    bool is_valid = false;
};

frame_of_trap frame_of(const trap_ellipsoid& trap) {
    frame_of_trap frame;
    const int n = trap.n_columns;
    for (int j = 0; j < n; ++j) {
        bool is_free = false;
        for (int i = 0; i < n; ++i) is_free = is_free || trap.shape[i * n + j] != 0.0;
        if (is_free) frame.free.push_back(j);
    }
    const int m = static_cast<int>(frame.free.size());
    frame.shape.n = m;
    for (int i = 0; i < m; ++i) {
        for (int j = 0; j < m; ++j) {
            frame.shape(i, j) = trap.shape[frame.free[static_cast<std::size_t>(i)] * n +
                                           frame.free[static_cast<std::size_t>(j)]];
        }
    }
    frame.inverse = approximate_inverse(frame.shape);
    const interval_matrix defect =
        product(interval_matrix::of(frame.shape), interval_matrix::of(frame.inverse)) -
        interval_matrix::identity(m);
    const double looseness = frobenius_bound(defect);
    frame.is_valid = m > 0 && looseness < loosest_frame;  // false for NaN too
    frame.radius = just_above(1.0 + 2.0 * looseness);     // >= 1 / (1 - looseness)
    return frame;
}

contraction_verdict verdict_of(enclosed_end end) {
    switch (end) {
        case enclosed_end::event_not_unique:
            return contraction_verdict::event_not_unique;
        case enclosed_end::not_supported:
            return contraction_verdict::not_supported;
        case enclosed_end::returned:
        case enclosed_end::ended:
            return contraction_verdict::not_contracting;
        case enclosed_end::undecided_comparison:
            break;
    }
    return contraction_verdict::undecided_comparison;
}

class prover {
public:
    prover(const orbit_functions& model, const contraction_query& query)
        : model_(model), query_(query), frame_(frame_of(query.trap)) {}

    contraction_bound run() {
        if (!frame_.is_valid || model_.enclose == nullptr) return bound_;
        piece centre;
        centre.is_ball = true;
        const enclosed_returns returns = enclose(centre);
        if (returns.end != enclosed_end::returned || !keeps_fixed_columns(returns)) {
            bound_.verdict = verdict_of(returns.end);
            return bound_;
        }
        bound_.defect = defect_of(returns);
        limit_ = 1.0 - bound_.defect - room();
        piece whole = centre;
        whole.half = frame_.radius;
        bound_.verdict = limit_ > 0.0 ? cover(whole) : contraction_verdict::not_contracting;
        return bound_;
    }

private:
    const orbit_functions& model_;
    const contraction_query& query_;
    frame_of_trap frame_;
    contraction_bound bound_;
    double limit_ = 0.0;

    int n_free() const { return frame_.shape.n; }

    enclosed_returns enclose(const piece& part) {
        enclosed_query query{.section = query_.section,
                             .options = query_.options,
                             .variant = query_.variant,
                             .parameters = query_.parameters,
                             .returns = query_.returns,
                             .max_steps = query_.max_steps};
        start_region& starts = query.starts;
        const int m = n_free();
        starts.n_columns = query_.trap.n_columns;
        starts.n_directions = m;
        std::copy_n(query_.trap.centre, starts.n_columns, starts.centre);
        for (int i = 0; i < m; ++i) {
            for (int j = 0; j < m; ++j) {
                starts.frame[frame_.free[static_cast<std::size_t>(i)] * m + j] =
                    frame_.inverse(i, j);
            }
        }
        std::copy_n(part.from, m, starts.from);
        starts.is_ball = part.is_ball;
        starts.radius = part.half;
        ++bound_.pieces;
        return model_.enclose(query);
    }

    bool keeps_fixed_columns(const enclosed_returns& returns) const {
        for (int j = 0; j < query_.trap.n_columns; ++j) {
            const bool is_free =
                std::find(frame_.free.begin(), frame_.free.end(), j) != frame_.free.end();
            const double c = query_.trap.centre[j];
            if (!is_free && !(returns.low[j] == c && returns.high[j] == c)) return false;
        }
        return true;
    }

    /// Largest column of the centre, by which the kernels' rounding is measured.
    double room() const {
        double size = 0.0;
        for (const int j : frame_.free) size = std::max(size, std::abs(query_.trap.centre[j]));
        double room = 0.0;
        for (int i = 0; i < n_free(); ++i) {
            for (int j = 0; j < n_free(); ++j) room += std::abs(frame_.shape(i, j));
        }
        return room * rounding_room * (size > 0.0 ? size : 1.0);
    }

    double defect_of(const enclosed_returns& returns) const {
        const int m = n_free();
        double square = 0.0;
        for (int i = 0; i < m; ++i) {
            interval row;
            for (int j = 0; j < m; ++j) {
                const int column = frame_.free[static_cast<std::size_t>(j)];
                const interval moved =
                    interval{returns.centre_low[column], returns.centre_high[column]} -
                    interval::point(query_.trap.centre[column]);
                row = row + interval::point(frame_.shape(i, j)) * moved;
            }
            square = just_above(square + just_above(row.size() * row.size()));
        }
        return just_above(just_above(std::sqrt(square)));
    }

    /// A D over one part, D the derivative with respect to v.
    interval_matrix derivative_of(const enclosed_returns& returns) const {
        const int m = n_free();
        interval_matrix slopes(m);
        for (int i = 0; i < m; ++i) {
            const int row = frame_.free[static_cast<std::size_t>(i)] * m;
            for (int j = 0; j < m; ++j) {
                slopes(i, j) = {returns.slope_low[row + j], returns.slope_high[row + j]};
            }
        }
        return product(interval_matrix::of(frame_.shape), slopes);
    }

    bool is_outside(const piece& part) const {
        double square = 0.0;
        for (int i = 0; i < n_free(); ++i) {
            const double nearest = std::max(0.0, std::abs(part.from[i]) - part.half);
            square += nearest * nearest;
        }
        return !part.is_ball && square > frame_.radius * frame_.radius * (1.0 + 1e-12);
    }

    /// Looks at a part; cuts it into cubes where it proves nothing as a whole.
    contraction_verdict cover(const piece& whole) {
        std::vector<piece> parts{whole};
        while (!parts.empty()) {
            const piece part = parts.back();
            parts.pop_back();
            if (is_outside(part)) continue;
            if (bound_.pieces >= query_.most_pieces) return last_;
            const enclosed_returns returns = enclose(part);
            last_ = verdict_of(returns.end);
            if (last_ == contraction_verdict::not_supported) return last_;
            if (returns.end == enclosed_end::ended) return last_;
            if (returns.end == enclosed_end::returned && keeps_fixed_columns(returns)) {
                const interval_matrix derivative = derivative_of(returns);
                const double norm = norm_bound(derivative) * frame_.radius;
                if (norm <= limit_) {
                    bound_.contraction = std::max(bound_.contraction, norm);
                    continue;
                }
                // no cut helps where even the middle expands
                if (least_norm(derivative) > limit_) {
                    bound_.contraction = std::max(bound_.contraction, norm);
                    return contraction_verdict::not_contracting;
                }
            }
            cut(part, parts);
        }
        return contraction_verdict::proved;
    }

    void cut(const piece& part, std::vector<piece>& parts) const {
        const int m = n_free();
        for (int corner = 0; corner < 1 << m; ++corner) {
            piece child = part;
            child.is_ball = false;
            child.half = 0.5 * part.half;
            for (int i = 0; i < m; ++i) {
                child.from[i] += ((corner >> i) & 1) != 0 ? child.half : -child.half;
            }
            // neighbours share their faces in spite of rounding
            child.half = just_above(child.half * (1.0 + 1e-14));
            parts.push_back(child);
        }
    }

    contraction_verdict last_ = contraction_verdict::undecided_comparison;
};

}  // namespace

std::string_view name_of(contraction_verdict verdict) {
    switch (verdict) {
        case contraction_verdict::proved:
            return "proved";
        case contraction_verdict::undecided_comparison:
            return "undecided comparison";
        case contraction_verdict::not_contracting:
            return "not contracting";
        case contraction_verdict::event_not_unique:
            return "event not unique";
        case contraction_verdict::not_supported:
            break;
    }
    return "not supported";
}

contraction_bound prove_contraction(const orbit_functions& model, const contraction_query& query) {
    return prover(model, query).run();
}

}  // namespace hopscotch
