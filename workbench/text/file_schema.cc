#include "workbench/text/file_schema.h"

#include <algorithm>
#include <cctype>
#include <cmath>
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

/** "ID" and "DIGIT" stand for any name. */
bool IsPlaceholder(const std::string& name) {
  return std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isupper(c); });
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
  if (row.type == KeyType::kBoolean) return {{"type", "boolean"}};
  const bool has_range = std::isfinite(row.low) || std::isfinite(row.high);
  return has_range || row.type == KeyType::kNumber ? MakeNumbers(row) : Json::object();
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
    if (child.row && child.row->fallback == kRequired &&
        child.row->type != KeyType::kNumberOfSome) {
      required.push_back(name);
    }
  }
  Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", others}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json MakeNode(const Node& node) {
  Json schema = node.children.empty() ? MakeLeaf(*node.row) : MakeMap(node);
  if (node.row && node.row->type == KeyType::kList) {
    schema = {{"type", "array"}, {"items", schema}};
  } else if (node.row && node.row->type == KeyType::kMap) {
    schema = {{"type", "object"}, {"additionalProperties", schema}};
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
