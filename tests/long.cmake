# The tests of each room that take longer than some seconds (label long), as a filter of GoogleTest. scripts/test leaves
# them out, scripts/before-resolve runs them.
set(long_app Memory.IsEstimatedWithinAQuarterInSpace:Plot.FiguresOfOneName*:Plot.DrawsBodiesInSpace*:Plot.LaysTheShapes*)
set(long_integrators Settling.MakesPressuresOfAStiffBall*)
set(long_linear Multigrid.AlongGridLines*)
set(long_part Cycles.BothSolversAgree:Cycles.CountTheSlidingDistance*:Cycles.DifferFrom*:Cycles.LoseWhat*:GradedMesh.IsScaledWhere*:PassingBall.*:PhaseErrors.*:SettledPressures.AreReachedBy*:WornLimits.BlockOnRingOfTriangles)
set(long_pair PairCandidates.WhatSinks*)
set(long_pin ConservativeNormal.WearsAsDeep*:Pin.WearFluxIsThat*)
set(long_problems *EveryScene*:Scenes.BlocksAddUp*)
set(long_stick Fretting.PhasesAreChosenByTheirError:PairFretting.ExplicitMethods*:PairFretting.JacobianEquals*:PairFretting.SimilarBodiesWearUntil*)
set(long_resume Kill.OneStepMethods*:Resume.OfACycle*)
set(long_budget Budget.OfFewPhases*:Budget.OfLargeSteps*:Budget.OfTheMeanOverPhases*:Plan.ChoosesPhases)
set(long_study StudyRuns.OnlyCompleteRuns*)
