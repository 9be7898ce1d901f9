// SPDX-License-Identifier: Apache-2.0
// A matrix whose rows are kept as a few quantised wavelet coefficients. Blocks of 16 neighbouring rows share
// one set of coefficients, so that a product reads one index and three light values for 16 rows. Laid out for
// vector units and compute shaders alike.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/rgb.h"
#include "transfer/coefficients.h"

namespace sconce {

/// Arrays may lie in a file's bytes; whoever made the rows keeps them alive.
struct WaveletRows {
  static constexpr std::size_t kBlock = 16;

  uint32_t columns = 0;               ///< n, a power of four, at most 65,536
  uint32_t rows = 0;                  ///< the last block is filled up with rows of zeros
  std::span<const uint32_t> first;    ///< per block and one more: range of coefficients
  std::span<const uint16_t> indices;  ///< per coefficient, ascending within a block, never 0
  std::span<const int8_t> codes;      ///< coefficient x kBlock, quantise.h
  std::span<const float> scales;      ///< per row, filled up: of its codes
  std::span<const float> means;       ///< per row, filled up: coefficient 0, exact
  std::span<const float> values;      ///< coefficient x kBlock, in place of codes where nothing is quantised

  std::size_t blocks() const { return first.empty() ? 0 : first.size() - 1; }
  uint64_t bytes() const {
    return first.size_bytes() + indices.size_bytes() + codes.size_bytes() + scales.size_bytes() +
           means.size_bytes() + values.size_bytes();
  }
  /// Multiplications of a product per row, and channel.
  double macs_per_row() const {
    return rows == 0 ? 0 : static_cast<double>(kBlock * indices.size()) / rows + 1;
  }
  /// Coefficient k, counted over all blocks, of row r of its block.
  float value(std::size_t block, std::size_t k, std::size_t r) const;
};

/// What a product does with coefficients of light that are 0: passing over them pays where most are.
enum class Zeros : uint8_t { multiply, skip };

/// rows x light, where the light is a transformed square (haar_forward). On the machine's vector units and
/// threads; the same bits at any number of threads. Of values that are not quantised sums are double.
/// @param light  columns
/// @param out    rows
void multiply(const WaveletRows& rows, std::span<const Rgbx> light, std::span<Rgb> out,
              Zeros zeros = Zeros::multiply);

enum class RowValues : uint8_t { codes, floats };

/// Compresses rows block by block, on any number of threads.
class WaveletRowsBuilder {
 public:
  WaveletRowsBuilder(uint32_t rows, uint32_t columns, std::size_t coefficients, std::vector<float> squares,
                     RowValues keep = RowValues::codes);

  /// One for each thread at a time.
  class Scratch {
   public:
    explicit Scratch(const WaveletRowsBuilder& builder)
        : chooser(builder.squares_), place(builder.columns_, 0), transformed(WaveletRows::kBlock) {}

   private:
    friend WaveletRowsBuilder;
    CoefficientChooser chooser;
    std::vector<uint16_t> place;
    std::vector<std::vector<SparseEntry>> transformed;
  };

  std::size_t blocks() const { return blocks_.size(); }
  /// Transforms, chooses and quantises.
  /// @param rows  up to kBlock sparse rows, ascending by column; used as scratch
  void set_block(std::size_t block, std::span<std::vector<SparseEntry>> rows, Scratch& scratch);
  /// Quantises coefficients that were chosen by the caller.
  /// @param chosen  ascending, without 0
  /// @param values  of all coefficients, kBlock rows at a time
  void set_block(std::size_t block, std::span<const uint32_t> chosen, std::span<const Sixteen> values);
  /// A finished block as bytes, for another builder of the same rows: processes share them, files keep them.
  void pack(std::size_t block, std::string& bytes) const;
  void unpack(std::size_t block, std::string_view& bytes);
  /// All blocks as one. The builder is then empty; the rows live as long as the result's owner.
  struct Result {
    WaveletRows rows;
    std::shared_ptr<const void> owner;
  };
  Result finish();

 private:
  struct Block {
    std::vector<uint16_t> indices;
    std::vector<int8_t> codes;
    std::vector<float> values;
    std::array<float, WaveletRows::kBlock> scales{}, means{};
  };
  uint32_t rows_, columns_;
  std::size_t coefficients_;
  std::vector<float> squares_;
  RowValues keep_;
  std::vector<Block> blocks_;
};

}  // namespace sconce
