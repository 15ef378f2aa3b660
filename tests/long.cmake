# The tests of each room that take longer than some seconds (label long), as a filter of GoogleTest. scripts/test leaves
# them out, scripts/before-resolve runs them.
set(long_problems EveryScene*)
set(long_part Cycles.BothSolversAgree:Cycles.CountTheSlidingDistance*:Cycles.DifferFrom*:Cycles.LoseWhat*:PhaseErrors.ChoosePhasesForFixedSteps:PhaseErrors.SeeWhat*)
set(long_pin ConservativeNormal.WearsAsDeep*)
set(long_resume Resume.OfACycle*)
