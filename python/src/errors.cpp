// SPDX-License-Identifier: MIT
// What is thrown here becomes an exception of the classes in libph/_errors.py, and no other.
#include <exception>
#include <new>
#include <system_error>

#include "bindings.hpp"
#include "ph/error.hpp"
#include "run.hpp"

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

void set_error(const char* class_name, const char* message) {
  const py::object type = py::module_::import("libph._errors").attr(class_name);
  // A file's name may be no UTF-8.
  const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
      message, static_cast<Py_ssize_t>(std::char_traits<char>::length(message)), "replace"));
  PyErr_SetObject(type.ptr(), text.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Timeout& error) {
    set_error("Timeout", error.what());
  } catch (const Error& error) {
    set_error(class_of(error.kind()), error.what());
  } catch (const std::bad_alloc&) {
    set_error("MemoryLimitError", "out of memory");
  } catch (const std::system_error& error) {  // no more threads, no more mutexes
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

void bind_errors() { py::register_exception_translator(translate); }

}  // namespace ph::python
