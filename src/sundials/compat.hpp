// The differences between the SUNDIALS versions that gnomon builds with, 6.4 (Debian 12) to 7.x, in
// one place. The code is written as for 7.1 and later; docs/building.md says how this was checked.
//
//   since  change (LLNL/sundials, CHANGELOG.md and headers)               here
//   7.0    realtype, booleantype are gone                                 6.x has sunrealtype, too
//   7.0    SUNContext_Create takes a SUNComm, with MPI an MPI_Comm        Context
//   7.0    XXXSetErrHandlerFn are gone; handlers belong to the context    Context, GNOMON_SILENCE
//   7.0    SUN_NLS_SUCCESS, SUNLS_SUCCESS, ... are gone; operations of
//          matrices and solvers return SUNErrCode, which is int           0 is success in both
//   7.0    SUN_NLS_CONV_RECVR and other positive codes stay               -
//   7.0    sundials_core is to be linked: by SUNDIALS' CMake targets      -
//   6.7    step sizes are chosen by a SUNAdaptController                  StepControl
//   6.7    ERKStep finds itself whether its last stage is the new value    -
//   7.1    ERKStepXXX deprecated for ARKodeXXX                            #define ARKodeXXX
//   7.3    other default tables and step size control                     all are set by gnomon
//   7.3    a controller begins as an I controller, its first two steps    -
//
// The tables that gnomon names, and its calls of KINSOL, IDA and SPFGMR, are the same in all
// versions.
#pragma once

#include <arkode/arkode_erkstep.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_types.h>

#define GNOMON_SUNDIALS (100 * SUNDIALS_VERSION_MAJOR + SUNDIALS_VERSION_MINOR)
#if GNOMON_SUNDIALS >= 607
#include <sunadaptcontroller/sunadaptcontroller_soderlind.h>
#endif

#include <utility>

/// Silences KINSOL's, IDA's or ARKODE's own messages: failures are reported by their return codes.
#if GNOMON_SUNDIALS >= 700
#define GNOMON_SILENCE(set_handler, memory) (void)(memory)
#else
#define GNOMON_SILENCE(set_handler, memory) \
  set_handler(                              \
      memory, [](int, const char*, const char*, char*, void*) {}, nullptr)
#endif

#if GNOMON_SUNDIALS < 701
#define ARKodeEvolve ERKStepEvolve
#define ARKodeFree ERKStepFree
#define ARKodeGetCurrentStep ERKStepGetCurrentStep
#define ARKodeGetNumErrTestFails ERKStepGetNumErrTestFails
#define ARKodeReset ERKStepReset
#define ARKodeSetAdaptController ERKStepSetAdaptController
#define ARKodeSetAdaptivityAdjustment ERKStepSetAdaptivityAdjustment
#define ARKodeSetFixedStep ERKStepSetFixedStep
#define ARKodeSetFixedStepBounds ERKStepSetFixedStepBounds
#define ARKodeSetInitStep ERKStepSetInitStep
#define ARKodeSetMaxErrTestFails ERKStepSetMaxErrTestFails
#define ARKodeSetMaxFirstGrowth ERKStepSetMaxFirstGrowth
#define ARKodeSetMaxGrowth ERKStepSetMaxGrowth
#define ARKodeSetMaxNumSteps ERKStepSetMaxNumSteps
#define ARKodeSetMaxStep ERKStepSetMaxStep
#define ARKodeSetSafetyFactor ERKStepSetSafetyFactor
#define ARKodeSetStopTime ERKStepSetStopTime
#define ARKodeSetUserData ERKStepSetUserData
#define ARKodeWFtolerances ERKStepWFtolerances
#endif

namespace gnomon::sundials {

/// Move-only owner of a SUNContext that prints nothing.
class Context {
public:
  Context() {
#if GNOMON_SUNDIALS >= 700
    SUNContext_Create(SUN_COMM_NULL, &context_);
    SUNContext_ClearErrHandlers(context_);
#else
    SUNContext_Create(nullptr, &context_);
#endif
  }
  ~Context() {
    if (context_) SUNContext_Free(&context_);
  }
  Context(Context&& other) noexcept : context_(std::exchange(other.context_, nullptr)) {}
  Context& operator=(Context&&) = delete;
  operator SUNContext() const {
    return context_;
  }

private:
  SUNContext context_ = nullptr;
};

/// A PI controller of ERKStep's steps, on the order of the method: h is multiplied by
/// safety * (bias e_n)^(-proportional/p) (bias e_(n-1))^(integral/p), and stays where it is between
/// `keep_from` and `keep_to` times its size.
struct PiController {
  double proportional, integral, bias, safety, keep_from, keep_to;
};

/// This controller in the form of the SUNDIALS in use. It must outlive the integrator that uses it.
class StepControl {
public:
#if GNOMON_SUNDIALS >= 607
  StepControl(const PiController& pi, SUNContext context)
      : pi_(pi), controller_(SUNAdaptController_PI(context)) {}
  ~StepControl() {
    SUNAdaptController_Destroy(controller_);
  }
  /// Returns the code of the call that failed, or 0.
  int give_to(void* erk) const {
    if (!controller_) return ARK_MEM_FAIL;
    int flag = SUNAdaptController_SetParams_PI(controller_, pi_.proportional, -pi_.integral);
    if (!flag) flag = SUNAdaptController_SetErrorBias(controller_, pi_.bias);
    if (!flag) flag = ARKodeSetAdaptController(erk, controller_);
    if (!flag) flag = ARKodeSetAdaptivityAdjustment(erk, 0);  // that of the estimate, plus one
    return flag ? flag : set_bounds(erk);
  }
#else
  StepControl(const PiController& pi, SUNContext) : pi_(pi) {}
  int give_to(void* erk) const {
    constexpr int pi_method = 1;
    double parameters[] = {pi_.proportional, pi_.integral, 0};
    int flag = ERKStepSetAdaptivityMethod(erk, pi_method, SUNFALSE, SUNTRUE, parameters);
    if (!flag) flag = ERKStepSetErrorBias(erk, pi_.bias);
    return flag ? flag : set_bounds(erk);
  }
#endif
  StepControl(const StepControl&) = delete;
  StepControl& operator=(const StepControl&) = delete;

private:
  int set_bounds(void* erk) const {
    const int flag = ARKodeSetSafetyFactor(erk, pi_.safety);
    return flag ? flag : ARKodeSetFixedStepBounds(erk, pi_.keep_from, pi_.keep_to);
  }
  PiController pi_;
#if GNOMON_SUNDIALS >= 607
  SUNAdaptController controller_;
#endif
};

}  // namespace gnomon::sundials
