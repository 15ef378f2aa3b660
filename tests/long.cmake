# The tests of each room that take longer than some seconds (label long), as filters of GoogleTest. scripts/test leaves
# them out, scripts/before-resolve runs them.
set(long_app Memory.IsEstimatedWithinAQuarterInSpace Plot.FiguresOfOneName* Plot.DrawsBodiesInSpace*
    Plot.LaysTheShapes* Plot.GeometryInThePlane Plot.DrawsAStudyASpectrum* Plot.AnUnwritableHome*)
set(long_integrators Settling.MakesPressuresOfAStiffBall*)
set(long_linear Multigrid.AlongGridLines*)
set(long_part Cycles.BothSolversAgree Cycles.CountTheSlidingDistance* Cycles.DifferFrom* Cycles.LoseWhat*
    GradedMesh.IsScaledWhere* PassingBall.* PhaseErrors.* SettledPressures.AreReachedBy*
    WornLimits.BlockOnRingOfTriangles Condensation.HasTheSolution*)
set(long_pair PairCandidates.WhatSinks* PairBalance.AShoeInSpace* SprungCam.SpringsAlone*
    PairPlaces.ARockerRestsWherever* PushedOut.AHubOnWeak*)
set(long_pin ConservativeNormal.WearsAsDeep* Pin.WearFluxIsThat*)
set(long_problems *EveryScene* Scenes.BlocksAddUp*)
set(long_stick Fretting.PhasesAreChosenByTheirError PairFretting.ExplicitMethods* PairFretting.JacobianEquals*
    PairFretting.SimilarBodiesWearUntil* Fretting.ExplicitMethodsKeep* Fretting.TheErrorOfThePhases*
    Fretting.TheFirstLoading* PairRolling.FrictionWithoutThePower* PairRolling.TheDepthIsExpected*
    RollingScenes.FreeRollingOfUnlike* RollingScenes.LargeStrains* PairRolling.AForceFinds*
    PairRolling.UnlikeBodies*)
set(long_resume Kill.OneStepMethods* Resume.OfACycle* Kill.BdfGoesOn*)
set(long_budget Budget.OfFewPhases* Budget.OfLargeSteps* Budget.OfTheMeanOverPhases* Plan.ChoosesPhases
    Plan.LeavesAndJudges*)
set(long_study StudyRuns.OnlyCompleteRuns* StudyRuns.AnotherStudysFolder* BySlurm.RunsThatNeverBegan* BySlurm.LostTasks*
    BySlurm.AKilledExecutor* BySlurm.AFailingQuery*
    StudyRuns.RunsWhoseResultCannot*)
set(long_extremes Extremes.TheCoarseSubset*)
set(long_results Crash.KilledAtRandom*)
set(long_run SettledEnd.IsThatOfAnObservation*)
