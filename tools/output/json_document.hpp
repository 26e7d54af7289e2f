// SPDX-License-Identifier: BSD-3-Clause
// The output of --json of a command: one object, which has standard output to itself. The text goes to standard error.
//
//   {"format": 1, "command": "run", "status": 0, "result": {...}}
//
// docs/schemas has the schema of each command's document, docs/json.md the rules by which they change.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace waitpoint::tools {

/// `result` is an object of JSON, `status` the exit status; none: a signal ends the process. Ends with a newline.
std::string json_document(const std::string& command, std::optional<int> status, const std::string& result);

/// Writes the document to standard output, and returns the status. Throws BadInput if it cannot be written.
int end_with_json(const std::string& command, int status, const std::string& result);

/// Writes a text for people: to standard error if standard output is for a document. Throws BadInput as
/// write_standard_output().
void write_text(std::string_view text, bool is_json);

}  // namespace waitpoint::tools
