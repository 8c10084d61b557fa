#pragma once
/** @file
Errors and texts as conditions of one line. */

#include <gtest/gtest.h>

#include <string>

#include "core/base/error.h"

namespace graspbench {

/** Whether a text has a part; prints both when it does not. */
inline testing::AssertionResult Has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << part << "\" is not in:\n" << text;
}

/** The text of the Error that an action throws; empty: it throws none. */
template <class Action>
std::string FindError(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/** Whether an action throws an Error of this kind whose text has the part. */
template <class Action>
testing::AssertionResult Throws(const Action& action, ErrorKind kind,
                                const std::string& part = "") {
  try {
    action();
  } catch (const Error& error) {
    if (error.kind() == kind) return Has(error.what(), part);
    return testing::AssertionFailure() << "another kind of error: " << error.what();
  }
  return testing::AssertionFailure() << "no error was thrown";
}

}  // namespace graspbench
