// The style sheet of a study's page, in the page itself: it refers to nothing outside.
#pragma once

namespace gnomon::study {

inline constexpr const char* page_style = R"(
:root { color-scheme: light; }
body { margin: 0 auto; max-width: 88rem; padding: 1.5rem; color: #1a1a1a; background: #fff;
       font: 16px/1.5 system-ui, sans-serif; }
h1 { margin: 0 0 .3rem; font-size: 1.6rem; line-height: 1.25; }
h2 { margin: 2.2rem 0 .6rem; font-size: 1.25rem; }
h3 { margin: 1.6rem 0 .4rem; font-size: 1.05rem; }
p, dl, ul { max-width: 52rem; }
dt { font-weight: 600; } dd { margin: 0 0 .5rem 1.2rem; }
code, pre { font-family: ui-monospace, monospace; font-size: .9em; }
pre { padding: .8rem; background: #f5f5f5; overflow-x: auto; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .88rem; line-height: 1.3; }
th, td { padding: .28rem .55rem; text-align: left; white-space: nowrap;
         border-bottom: 1px solid #ddd; }
th { vertical-align: bottom; border-bottom: 2px solid #888; background: #fff; }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; }
td.wrap { white-space: normal; min-width: 16rem; }
tbody tr:hover { background: #f3f7fb; }
.unit { font-weight: 400; color: #555; }
td.marked, dt.marked { color: #7a4a00; background: #fff3d6; }
tr.failed td { color: #8a1020; background: #fdeeee; }
figure { margin: 1rem 0; } figure svg { max-width: 100%; height: auto; }
.note { padding: .6rem .9rem; background: #f2f2f2; max-width: 52rem; }
)";

}  // namespace gnomon::study
