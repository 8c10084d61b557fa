#pragma once
/** @file
Builds an MCAP file: messages of several channels in the order of time, in compressed chunks, with
index, statistics and metadata.

Source: the MCAP format specification, version 0, https://mcap.dev/spec. Compression is zstd
(package libzstd-dev), checksums are CRC-32 (zlib). Not written: attachments. */

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace graspbench {

class McapFile {
 public:
  /** @param library  name of the writing program. */
  explicit McapFile(const std::string& library);

  /** @param encoding  "protobuf": `data` is a serialised FileDescriptorSet. @returns the schema's
  id. */
  uint16_t AddSchema(const std::string& name, const std::string& encoding, const std::string& data);
  /** @param encoding  of the messages. @returns the channel's id. */
  uint16_t AddChannel(uint16_t schema, const std::string& topic, const std::string& encoding);
  /** @param time  not before that of the previous message [ns]. */
  void AddMessage(uint16_t channel, uint64_t time, std::string_view data);
  void AddMetadata(const std::string& name, const std::map<std::string, std::string>& values);

  /** Returns the file's bytes; call once, at the end. */
  std::string Finish();

 private:
  struct MessagePlace {
    uint64_t time, offset;  // offset in its chunk
  };

  void FinishChunk();

  std::string file_;
  std::string schemas_, channels_;  // records for the first chunk and the summary
  uint16_t num_schemas_ = 0, num_channels_ = 0;
  std::string chunk_;  // records of the current one
  uint64_t chunk_start_ = 0, chunk_end_ = 0;
  std::map<uint16_t, std::vector<MessagePlace>> chunk_messages_;
  std::string chunk_indexes_, metadata_indexes_;
  uint32_t num_chunks_ = 0, num_metadata_ = 0, sequence_ = 0;
  uint64_t start_ = 0, end_ = 0;
  std::map<uint16_t, uint64_t> num_messages_;  // by channel
};

}  // namespace graspbench
