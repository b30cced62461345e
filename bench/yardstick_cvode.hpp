// SUNDIALS CVODE as the solver of the physical hopper: Adams with fixed-point iteration and CVODE's
// own rootfinding (Illinois), which knows that a root at the launch itself does not count.
#pragma once

#include "bench/physical_hopper.hpp"

#include <stdexcept>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

namespace hopscotch::bench {

/// One CVODE memory: N states, some events.
template <int N>
class cvode_problem {
public:
    using state = std::array<double, N>;

    cvode_problem(physical_hopper& hopper, CVRhsFn rates, double tolerance, CVRootFn events,
                  std::initializer_list<int> directions) {
#if SUNDIALS_VERSION_MAJOR >= 7
        check(SUNContext_Create(SUN_COMM_NULL, &context_));
#else
        check(SUNContext_Create(nullptr, &context_));
#endif
        y_ = N_VNew_Serial(N, context_);
        N_VConst(0.0, y_);
        memory_ = CVodeCreate(CV_ADAMS, context_);
        check(CVodeInit(memory_, rates, 0.0, y_));
        check(CVodeSStolerances(memory_, tolerance, tolerance));
        check(CVodeSetUserData(memory_, &hopper));
        check(CVodeSetMaxNumSteps(memory_, 1000000));
        iteration_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
        check(CVodeSetNonlinearSolver(memory_, iteration_));
        check(CVodeRootInit(memory_, static_cast<int>(directions.size()), events));
        std::array<int, 2> wanted{};
        std::copy(directions.begin(), directions.end(), wanted.begin());
        check(CVodeSetRootDirection(memory_, wanted.data()));
        check(CVodeSetNoInactiveRootWarn(memory_));
    }
    ~cvode_problem() {
        CVodeFree(&memory_);
        SUNNonlinSolFree(iteration_);
        N_VDestroy(y_);
        SUNContext_Free(&context_);
    }
    cvode_problem(const cvode_problem&) = delete;
    cvode_problem& operator=(const cvode_problem&) = delete;

    /// Integrates to the next event; true where there was one.
    bool advance(state& y, double& time) {
        double* values = N_VGetArrayPointer(y_);
        std::copy(y.begin(), y.end(), values);
        check(CVodeReInit(memory_, 0.0, y_));
        double reached = 0.0;
        const int code = CVode(memory_, longest_phase, y_, &reached, CV_NORMAL);
        std::copy(values, values + N, y.begin());
        time += reached;
        return code == CV_ROOT_RETURN;
    }
    /// Which event it was.
    std::array<int, 2> events_found() {
        std::array<int, 2> found{};
        check(CVodeGetRootInfo(memory_, found.data()));
        return found;
    }

private:
    static void check(int code) {
        if (code < 0) throw std::runtime_error("CVODE refuses its settings");
    }

    SUNContext context_ = nullptr;
    N_Vector y_ = nullptr;
    void* memory_ = nullptr;
    SUNNonlinearSolver iteration_ = nullptr;
};

class cvode_solver {
public:
    static constexpr const char* name = "SUNDIALS CVODE Adams + rootfinding";

    cvode_solver(physical_hopper hopper, double tolerance)
        : hopper_(hopper),
          flight_(hopper_, flight_rates, tolerance, gap, {-1}),
          contact_(hopper_, contact_rates, tolerance, lift_or_turn, {1, -1}) {}

    const physical_hopper& model() const { return hopper_; }

    bool fly(flight_state& y, double& time) { return flight_.advance(y, time); }

    return_end stand(contact_state& y, double& time) {
        if (!contact_.advance(y, time)) return return_end::lost;
        return contact_.events_found()[0] != 0 ? return_end::lifted : return_end::stuck;
    }

private:
    static const physical_hopper& hopper_of(void* data) {
        return *static_cast<const physical_hopper*>(data);
    }
    static int flight_rates(sunrealtype, N_Vector y, N_Vector rate, void* data) {
        hopper_of(data).flight(N_VGetArrayPointer(y), N_VGetArrayPointer(rate));
        return 0;
    }
    static int contact_rates(sunrealtype, N_Vector y, N_Vector rate, void* data) {
        hopper_of(data).contact(N_VGetArrayPointer(y), N_VGetArrayPointer(rate));
        return 0;
    }
    static int gap(sunrealtype, N_Vector y, sunrealtype* value, void*) {
        value[0] = N_VGetArrayPointer(y)[2];
        return 0;
    }
    static int lift_or_turn(sunrealtype, N_Vector y, sunrealtype* value, void*) {
        value[0] = N_VGetArrayPointer(y)[0] - 1.0;
        value[1] = N_VGetArrayPointer(y)[1];
        return 0;
    }

    physical_hopper hopper_;
    cvode_problem<4> flight_;
    cvode_problem<2> contact_;
};

}  // namespace hopscotch::bench
