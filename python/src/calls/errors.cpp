// SPDX-License-Identifier: MIT
// This file translates exceptions of C++ into the exception classes of libph/_errors.py.
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "ph/error.hpp"
#include "ph/run_context.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/calls/words.hpp"

namespace ph::python {
namespace {

const char* class_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return "UsageError";
    case ErrorKind::bad_data:
      return "DataError";
    case ErrorKind::no_input:
      return "MissingInputError";
    case ErrorKind::not_built_in:
      return "NotBuiltIn";
    case ErrorKind::cannot_create:
    case ErrorKind::io:
      return "OutputError";
    case ErrorKind::resource:
      return "MemoryLimitError";
    case ErrorKind::cancelled:
      return "Cancelled";
    case ErrorKind::internal:
      break;
  }
  return "InternalError";
}

/// Converts a text to Python. The name of a file may not be valid UTF-8.
py::object text_of(std::string_view text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
}

void set_error(const char* class_name, const char* message) {
  const py::object type = py::module_::import("libph._errors").attr(class_name);
  PyErr_SetObject(type.ptr(), text_of(message).ptr());
}

/// An exception with the attributes of the class Error in libph/_errors.py.
py::object exception_of(const Error& error, const char* class_name) {
  const Message message = error.message();
  const py::object type = py::module_::import("libph._errors").attr(class_name);
  py::object exception = type(text_of(message.in_words(kWords)));
  py::list remedies;
  for (const auto& [setting, value] : message.remedies())
    if (const Keyword keyword = keyword_of(setting, value); !keyword.name.empty())
      remedies.append(py::make_tuple(keyword.name, text_of(keyword.value)));
  exception.attr("remedies") = py::tuple(remedies);
  exception.attr("_place") = text_of(message.place());
  exception.attr("_found") = text_of(message.found());
  return exception;
}

void set_error(const py::object& exception) {
  PyErr_SetObject(py::type::handle_of(exception).ptr(), exception.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Timeout& error) {
    set_error("Timeout", error.what());
  } catch (const InputError& error) {
    const py::object exception = exception_of(error, class_of(error.kind()));
    exception.attr("_input") = error.input();
    exception.attr("_cause") = exception_of(error.cause(), class_of(error.kind()));
    set_error(exception);
  } catch (const Error& error) {
    set_error(exception_of(error, class_of(error.kind())));
  } catch (const std::bad_alloc&) {
    set_error("MemoryLimitError", "out of memory");
    // Thrown if there are no more threads or mutexes.
  } catch (const std::system_error& error) {
    set_error("MemoryLimitError", error.what());
  } catch (const py::error_already_set&) {
    throw;
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const std::exception& error) {
    set_error("InternalError", error.what());
  }
}

}  // namespace

void bind_errors(py::module_& m) {
  py::register_exception_translator(translate);
  m.def("keywords", [] {
    py::dict keywords;
    for (const auto& [setting, name] : names_of<Setting>)
      keywords[py::str(std::string(name))] = keyword_of(setting, "").name;
    return keywords;
  });
}

}  // namespace ph::python
