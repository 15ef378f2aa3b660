#!/usr/bin/env bash
# Installs a build and uses the installation from outside of the source tree, as users do:
#   check.sh CHECK BUILD SOURCE     CHECK is one of the functions below; `install` comes first
# Everything is below BUILD/package; each check ends with an error where something is not as it should be.
set -euo pipefail
check=$1 build=$2 source=$3
work=$build/package
prefix="$work/moved prefix"  # with a blank, as a folder of a user may have
gnomon=$prefix/bin/gnomon
unset GNOMON_PREFIX GNOMON_PLUGINS
export OMP_NUM_THREADS=1

fail() { echo "check.sh $check: $*" >&2; exit 1; }
expect() { grep -qE -- "$1" <<<"$2" || fail "expected \"$1\" in: $2"; }
# refused PATTERN COMMAND...: exit code 2 and one line with the pattern.
refused() {
  local pattern=$1 code=0 text
  shift
  text=$("$@" 2>&1 >/dev/null) || code=$?
  ((code == 2)) || fail "exit code $code, expected 2, of: $*"
  (($(wc -l <<<"$text") == 1)) || fail "expected one line: $text"
  expect "$pattern" "$text"
}
configure() { cmake -S "$1" -B "$2" -G Ninja "-DCMAKE_PREFIX_PATH=$prefix" "${@:3}" >/dev/null; }

install() {
  rm -rf "$work"
  cmake --install "$build" --prefix "$work/first" >/dev/null
  mv "$work/first" "$prefix"
}

relocated() {
  # No file that is executed or linked knows where it was built.
  local found
  found=$(grep -rlF -e "$source" -e "$work/first" "$prefix/bin" "$prefix"/lib* || true)
  [[ -z $found ]] || fail "a path of the source tree or of the first prefix is in: $found"
  cd "$work"
  expect "^gnomon [0-9.]+" "$("$gnomon" --version)"
  expect "moved prefix/share/gnomon/problems/pin_on_flat/small_deformation.toml" "$("$gnomon" list scenes)"
  "$gnomon" run "$prefix/share/gnomon/problems/pin_on_flat/small_deformation.toml" --quiet --force -o pin.h5 \
    --set 'mesh.elements=[8, 8]' --set time.end=50
  expect "pin_on_flat" "$("$gnomon" info pin.h5)"
  if [[ -e $prefix/libexec/gnomon/gnomon_gmsh ]]; then
    expect "nodes" "$("$gnomon" mesh "$prefix/share/gnomon/problems/worn_body/block_on_ring.geo")"
  fi
  if [[ -e $prefix/libexec/gnomon/gnomon_multigrid.so ]]; then
    "$gnomon" run "$prefix/share/gnomon/problems/ball_on_flat/small_deformation.toml" --quiet --force \
      -o ball.h5 --set 'mesh.elements=[3, 2, 2]' --set time.end=1 --set solver.preconditioner=multigrid
  fi
  "$gnomon" plot pin.h5 -o figures >/dev/null
  compgen -G "figures/*.png" >/dev/null || fail "gnomon plot made no figure"
  rm -rf sweep
  printf 'scene = "%s"\nreference = "none"\n[set]\nmesh.elements = [8, 8]\ntime.end = 50.0\n' \
    "$prefix/share/gnomon/problems/pin_on_flat/small_deformation.toml" >sweep.toml
  "$gnomon" study sweep.toml -o sweep --quiet
  expect "</html>" "$(cat sweep/index.html)"
}

manual() {
  local page=$prefix/share/man/man1/gnomon.1
  expect "body.young_modulus" "$(sed 's/\\//g' "$page")"
  expect "several of both with commas" "$(sed 's/\\//g' "$page" | grep -A1 NUMBERS)"
  # shellcheck source=/dev/null
  source "$prefix/share/bash-completion/completions/gnomon"
  # completed PATTERN WORD...: what the last word is completed to. bash gives "=" as a word of its own.
  completed() {
    COMP_WORDS=(gnomon "${@:2}") COMP_CWORD=$(($# - 1)) COMPREPLY=()
    _gnomon 2>/dev/null || true  # the code of the last search
    [[ ${COMPREPLY[*]} =~ ^($1)$ ]] || fail "${*:2} is completed to ${COMPREPLY[*]}, expected $1"
  }
  # A folder of its own: the checks beside this one write files whose names would be completed, too.
  rm -rf "$work/completion" && mkdir "$work/completion" && cd "$work/completion"
  completed ".*esdirk-3 .*" run x.toml --integrator esd
  completed "esdirk-5 ?.*" run x.toml --integrator = esdirk-5
  completed "stability" sta
  completed "wear.law=" run x.toml --set wear.la
  completed "archard" run x.toml --set wear.law = arch
  completed "false true" --plugin my.so run x.toml --set output.settle =
  completed "wear.law=archard" run x.toml --set wear.law=arch
  completed "" run x.toml --set load.force = 3
  touch ring.msh
  completed "ring.msh" run x.toml --set mesh.file = rin
  completed "pin_on_flat" help scene pin
  completed "scene" help sce
  completed "run" study ru
  completed "--lost-after" study run --l
  completed "plan" study pla
  completed "" study collect --res
  completed "slurm" study x.toml --executor sl
  completed "shapes" list sh
}

plugin() {
  configure "$source/examples/plugin" "$work/plugin"
  cmake --build "$work/plugin" >/dev/null
  cd "$work"
  local my=$work/plugin/my_wear.so cone=$source/examples/plugin/cone.toml
  expect "crouzeix-3" "$("$gnomon" --plugin "$my" list integrators)"
  # The scene against its closed form, and the order of the method: an eighth of the error with half the step.
  local coarse fine
  "$gnomon" --plugin "$my" run "$cone" --force --quiet -o cone.h5 --summary cone.json
  error_of() {
    "$gnomon" --plugin "$my" run "$cone" --force --quiet -o "cone$1.h5" --summary - --set "integrator.step=$1" \
      --set integrator.nonlinear_fraction=0 |
      python3 -c 'import json, sys; print(abs(json.load(sys.stdin)["depth_error"]))'
  }
  coarse=$(error_of 20) fine=$(error_of 10)
  python3 - "$coarse" "$fine" cone.json <<'PY'
import json, math, sys
coarse, fine = map(float, sys.argv[1:3])
order = math.log2(coarse / fine)
assert 2.7 < order < 3.3, f"order {order} from {coarse} and {fine}"
error = json.load(open(sys.argv[3]))["depth_error"]
assert abs(error) < 1e-5, f"error of the run with error control: {error}"
PY
  # The law: twice the wear at first, as the law says, and Archard's without its excess.
  local pin=$source/problems/pin_on_flat/small_deformation.toml
  worn_of() {
    "$gnomon" run "$pin" --force --quiet -o law.h5 --summary - --set 'mesh.elements=[8, 8]' --set time.end=10 "$@" |
      python3 -c 'import json, sys; print(json.load(sys.stdin)["wear_integral"])'
  }
  GNOMON_PLUGINS=$my worn_of --set wear.law=running-in --set wear.layer=1e6 >twice
  GNOMON_PLUGINS=$my worn_of --set wear.law=running-in --set wear.excess=0 >same
  worn_of >plain
  python3 - <<'PY'
twice, same, plain = (float(open(name).read()) for name in ("twice", "same", "plain"))
assert abs(twice / plain - 2) < 1e-4, f"{twice} is not twice {plain}"
assert abs(same / plain - 1) < 1e-6, f"{same} is not {plain}"
PY
  # The part of plain data, with the law of the plug-in: as from arrays in Python.
  "$gnomon" --plugin "$my" run "$source/examples/plugin/cyclic_flat.toml" --force --quiet -o flat.h5 --summary flat.json
  python3 - flat.json "$source/docs/howto/arrays.md" <<'PY'
import json, re, sys
worn, page = json.load(open(sys.argv[1]))["worn_volume"], open(sys.argv[2]).read()
by_arrays = float(re.search(r"^worn area ([0-9.]+) um", page, re.MULTILINE)[1])
assert abs(1e6 * worn / by_arrays - 1) < 1e-5, f"{1e6 * worn} is not {by_arrays}"
PY
  refused 'unknown integrator "crouzeix-3"|worn_cone' "$gnomon" run "$cone"
  # Without the plug-in: a result that did not use it goes on, others say what is missing. Processes that a study
  # starts have the plug-in, too.
  GNOMON_PLUGINS=$my worn_of >unused
  "$gnomon" resume law.h5 --end 20 --quiet
  local missing='if the run had a plug-in, load it by --plugin FILE.so'
  refused "$missing" "$gnomon" resume cone.h5 --end 2000
  GNOMON_PLUGINS=$my worn_of --set wear.law=running-in >used
  refused "wear.law.*$missing" "$gnomon" resume law.h5 --end 20
  "$gnomon" --plugin "$my" resume law.h5 --end 20 --quiet
  printf 'scene = "%s"\nreference = "none"\n' "$cone" >cones.toml
  rm -rf cones
  "$gnomon" --plugin "$my" study cones.toml -o cones --quiet
  local module python
  module=$(find "$prefix" -type d -name dist-packages -o -type d -name site-packages | head -1)
  python=$(sed -n 's/^_Python_EXECUTABLE:[^=]*=//p' "$build/CMakeCache.txt")
  [[ -z $module ]] || PYTHONPATH=$module "$python" - "$my" <<'PY'
import sys, gnomon
gnomon.load_plugin(sys.argv[1])
gnomon.study("cones.toml", "again")
PY
  # A physics finds its headers in the installation (docs/integrators.md).
  local physics
  for physics in stressed_surface/stressed_surface winkler/winkler winkler/foundation_scene winkler/phases; do
    c++ -std=c++20 -fsyntax-only -I"$prefix/include" -I/usr/include/eigen3 "$source/problems/$physics.cpp"
  done
}

bad_plugins() {
  configure "$source/tests/package/bad_plugins" "$work/bad_plugins"
  cmake --build "$work/bad_plugins" >/dev/null
  cd "$work"
  echo "no library" >text.so
  refused "text.so: has no stamp" "$gnomon" --plugin text.so list laws
  sed 's/interface [0-9a-f]*"/interface another"/' "$prefix/share/gnomon/cmake/interface.cpp" >another.cpp
  c++ -std=c++20 -fPIC -shared -I"$prefix/include" -I/usr/include/eigen3 another.cpp \
    "$source/examples/plugin/running_in.cpp" -o another.so
  refused "another.so: was compiled for another gnomon" "$gnomon" --plugin another.so list laws
  c++ -std=c++20 -fPIC -shared -I"$prefix/include" -I/usr/include/eigen3 \
    "$source/examples/plugin/running_in.cpp" -o unstamped.so
  refused "unstamped.so: has no stamp" "$gnomon" --plugin unstamped.so list laws
  refused "nowhere.so: there is no such file" "$gnomon" --plugin nowhere.so list laws
  refused "empty.so: registers nothing" "$gnomon" --plugin bad_plugins/empty.so list laws
  refused "nothing.so: \"nothing\" is registered without .make." "$gnomon" --plugin bad_plugins/nothing.so list laws
  local code=0 text
  text=$("$gnomon" --plugin bad_plugins/throws.so run "$source/problems/winkler/pin.toml" --quiet --force -o throws.h5 \
    --integrator throws 2>&1) || code=$?
  ((code == 1)) || fail "exit code $code, expected 1, where a plug-in throws a number"
  expect "^gnomon: a plug-in threw something" "$text"
  refused "twice.so: \"archard\" is registered twice" "$gnomon" --plugin bad_plugins/twice.so list laws
  refused "GNOMON_PLUGINS: plug-in nowhere.so" env GNOMON_PLUGINS=nowhere.so "$gnomon" list laws
}

embedding() {
  configure "$source/examples/embedding" "$work/embedding"
  cmake --build "$work/embedding" >/dev/null
  local text
  text=$("$work/embedding/wear_depth" "$source/problems/winkler/pin.toml")
  expect "^esdirk-3: [0-9]+ steps, worn volume" "$text"
  expect "^bdf: [0-9]+ steps, worn volume" "$text"
  refused "wear_depth: .*nothing.toml" "$work/embedding/wear_depth" nothing.toml
}

# gnomon inside of another project: its targets exist there, and headers are found. Only the other project's own
# file is compiled; scripts/matrix builds everything.
subdirectory() {
  cmake -S "$source/tests/package/subdirectory" -B "$work/subdirectory" -G Ninja -DGNOMON_SOURCE="$source" >/dev/null
  cmake --build "$work/subdirectory" --target embedding/CMakeFiles/wear_depth.dir/wear_depth.cpp.o >/dev/null
}

"$check"
