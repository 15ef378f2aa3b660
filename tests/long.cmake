# The tests of each room that take longer than some seconds (label long), as a filter of GoogleTest. scripts/test leaves
# them out, scripts/before-resolve runs them.
set(long_problems EveryScene*)
