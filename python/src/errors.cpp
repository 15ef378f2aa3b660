// Exceptions: gnomon.Error and the classes below it, with the same meaning as in C++.

#include <gnomon/base/error.hpp>
#include <gnomon/base/mistakes.hpp>

#include "bindings.hpp"

namespace gnomon::python {

namespace {

// Of the module, which is never unloaded.
struct Classes {
  py::handle error, input, solution, recoverable;
};
Classes classes;

py::handle new_class(py::module_& module, const char* name, const char* help,
                     std::initializer_list<py::handle> bases) {
  py::tuple parents(bases.size());
  std::size_t place = 0;
  for (py::handle base : bases) parents[place++] = base;
  const std::string full = std::string("gnomon.") + name;
  py::object made = py::reinterpret_steal<py::object>(
      PyErr_NewExceptionWithDoc(full.c_str(), help, parents.ptr(), nullptr));
  if (!made) throw py::error_already_set();
  module.attr(name) = made;
  return made.release();
}

/// InputError has all mistakes in `lines`.
void raise_input_error(const std::string& message, const std::vector<std::string>& lines) {
  py::object error = py::reinterpret_borrow<py::object>(classes.input)(message);
  error.attr("lines") = lines;
  PyErr_SetObject(classes.input.ptr(), error.ptr());
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputErrors& errors) {
    raise_input_error(joined(errors.lines), errors.lines);
  } catch (const InputError& error) {
    raise_input_error(error.what(), {error.what()});
  } catch (const SolutionError& error) {
    PyErr_SetString(classes.solution.ptr(), error.what());
  } catch (const RecoverableError& error) {
    PyErr_SetString(classes.recoverable.ptr(), error.what());
  } catch (const Error& error) {
    PyErr_SetString(classes.error.ptr(), error.what());
  }
}

}  // namespace

void throw_as_own(const py::error_already_set& error) {
  const std::string message = py::str(error.value());
  if (error.matches(classes.solution)) throw SolutionError(message);
  if (error.matches(classes.recoverable)) throw RecoverableError(message);
  throw error;
}

void add_errors(py::module_& module) {
  classes.error = new_class(module, "Error", "Base of gnomon's exceptions.", {PyExc_RuntimeError});
  classes.input = new_class(
      module, "InputError",
      "A scene, file or argument is wrong. `lines`: every mistake, with what, where and what was "
      "expected.",
      {classes.error, PyExc_ValueError});
  classes.solution =
      new_class(module, "SolutionError", "The solution could not be continued.", {classes.error});
  classes.recoverable = new_class(
      module, "RecoverableError",
      "The residual has no value at this state (an inverted element); a shorter step may help.",
      {classes.error});
  py::register_exception_translator(translate);
}

}  // namespace gnomon::python
