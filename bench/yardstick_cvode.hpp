// SUNDIALS CVODE as the solver of a hybrid system: Adams with fixed-point iteration and CVODE's own
// rootfinding (Illinois), which knows that a root at the beginning of a phase does not count.
#pragma once

#include "bench/hybrid_system.hpp"

#include <algorithm>
#include <stdexcept>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

namespace hopscotch::bench {

template <hybrid_system System>
class cvode_solver {
public:
    static constexpr const char* name = "SUNDIALS CVODE Adams + rootfinding";

    /// \param tolerance  absolute and relative
    explicit cvode_solver(double tolerance) {
#if SUNDIALS_VERSION_MAJOR >= 7
        check(SUNContext_Create(SUN_COMM_NULL, &context_));
#else
        check(SUNContext_Create(nullptr, &context_));
#endif
        y_ = N_VNew_Serial(n_states, context_);
        N_VConst(0.0, y_);
        memory_ = CVodeCreate(CV_ADAMS, context_);
        check(CVodeInit(memory_, rates, 0.0, y_));
        check(CVodeSStolerances(memory_, tolerance, tolerance));
        check(CVodeSetMaxNumSteps(memory_, 1000000));
        iteration_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
        check(CVodeSetNonlinearSolver(memory_, iteration_));
        check(CVodeRootInit(memory_, System::n_guards, guards));
        std::array<int, System::n_guards> falling;
        falling.fill(-1);
        check(CVodeSetRootDirection(memory_, falling.data()));
        check(CVodeSetNoInactiveRootWarn(memory_));
#if SUNDIALS_VERSION_MAJOR < 7
        CVodeSetErrFile(memory_, nullptr);  // a failed step is counted as lost, not printed
#endif
    }
    ~cvode_solver() {
        CVodeFree(&memory_);
        SUNNonlinSolFree(iteration_);
        N_VDestroy(y_);
        SUNContext_Free(&context_);
    }
    cvode_solver(const cvode_solver&) = delete;
    cvode_solver& operator=(const cvode_solver&) = delete;

    int advance(System& system, typename System::state& y, double& time) {
        constexpr double many_scales = 1e4;
        double* values = N_VGetArrayPointer(y_);
        std::copy(y.begin(), y.end(), values);
        check(CVodeSetUserData(memory_, &system));
        check(CVodeReInit(memory_, time, y_));
        const double stop = system.stop_time();
        const double longest = time + many_scales * System::time_scale;
        if (stop < longest) check(CVodeSetStopTime(memory_, stop));
        const int code = CVode(memory_, std::min(stop, longest), y_, &time, CV_NORMAL);
        std::copy(values, values + n_states, y.begin());
        if (code == CV_ROOT_RETURN) {
            std::array<int, System::n_guards> found{};
            check(CVodeGetRootInfo(memory_, found.data()));
            return static_cast<int>(
                std::ranges::find_if(found, [](int is_root) { return is_root != 0; }) -
                found.begin());
        }
        const bool stopped = code == CV_TSTOP_RETURN || (code == CV_SUCCESS && time >= stop);
        return stopped ? -1 : -2;
    }

private:
    static constexpr int n_states = static_cast<int>(std::tuple_size_v<typename System::state>);

    static void check(int code) {
        if (code < 0) throw std::runtime_error("CVODE refuses its settings");
    }
    static int rates(sunrealtype t, N_Vector y, N_Vector rate, void* system) {
        static_cast<const System*>(system)->rates(t, N_VGetArrayPointer(y),
                                                  N_VGetArrayPointer(rate));
        return 0;
    }
    static int guards(sunrealtype t, N_Vector y, sunrealtype* values, void* system) {
        static_cast<const System*>(system)->guards(t, N_VGetArrayPointer(y), values);
        return 0;
    }

    SUNContext context_ = nullptr;
    N_Vector y_ = nullptr;
    void* memory_ = nullptr;
    SUNNonlinearSolver iteration_ = nullptr;
};

}  // namespace hopscotch::bench
