#include "workbench/text/file_schema.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace graspbench {
namespace {

/** A key with what lies below it, as the rows' dots nest them. */
struct Node {
  const FileKey* row = nullptr;
  std::map<std::string, Node> children;
};

Node MakeTree(const FileKeys& keys) {
  Node root;
  for (const FileKey& key : keys) {
    Node* node = &root;
    for (size_t start = 0, end = 0; end != key.key.npos; start = end + 1) {
      end = key.key.find('.', start);
      node = &node->children[key.key.substr(start, end == key.key.npos ? end : end - start)];
    }
    node->row = &key;
  }
  return root;
}

bool Begins(const FileKey* row, const char* word) {
  return row && row->meaning.rfind(word, 0) == 0;
}

/** "ID" and "DIGIT" stand for any name. */
bool IsPlaceholder(const std::string& name) {
  return std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isupper(c); });
}

bool IsNumber(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

/** A number in range, or several, in lists or by name (the postures of a grasp). */
Json MakeNumbers(const FileKey& row) {
  Json number = {{"type", "number"}};
  if (row.low == kAboveZero) {
    number["exclusiveMinimum"] = 0;
  } else if (std::isfinite(row.low)) {
    number["minimum"] = row.low;
  }
  if (std::isfinite(row.high)) number["maximum"] = row.high;
  const Json list = {{"type", "array"}, {"items", number}};
  return {{"anyOf", {number, list, {{"type", "object"}}}}};
}

Json MakeLeaf(const FileKey& row) {
  if (row.fallback == "true" || row.fallback == "false") return {{"type", "boolean"}};
  const bool has_range = std::isfinite(row.low) || std::isfinite(row.high);
  if (has_range || IsNumber(row.fallback)) return MakeNumbers(row);
  return Json::object();
}

Json MakeNode(const Node& node);

Json MakeMap(const Node& node) {
  Json properties = Json::object();
  Json required = Json::array();
  Json others = false;
  for (const auto& [name, child] : node.children) {
    if (IsPlaceholder(name)) {
      others = MakeNode(child);
      continue;
    }
    properties[name] = MakeNode(child);
    // What is needed "of joints that turn" is not needed of others.
    if (child.row && child.row->fallback == kRequired && !Begins(child.row, "of ")) {
      required.push_back(name);
    }
  }
  Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", others}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json MakeNode(const Node& node) {
  Json schema = node.children.empty() ? MakeLeaf(*node.row) : MakeMap(node);
  if (Begins(node.row, "list")) {
    const Json items = node.children.empty() ? Json::object() : schema;
    schema = {{"type", "array"}, {"items", items}};
  } else if (Begins(node.row, "a map:")) {
    const Json values = node.children.empty() ? Json::object() : schema;
    schema = {{"type", "object"}, {"additionalProperties", values}};
  }
  if (node.row) schema["description"] = node.row->meaning;
  return schema;
}

}  // namespace

Json MakeFileSchema(const FileFormat& format) {
  Json schema = MakeMap(MakeTree(format.keys));
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = format.name;
  schema["description"] = format.about;
  return schema;
}

}  // namespace graspbench
