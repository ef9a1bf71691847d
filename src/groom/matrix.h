#pragma once

#include <cstddef>
#include <vector>

namespace mane {

/// A square matrix by rows, for the few small questions that are asked of a wisp before it moves.
class Matrix {
  public:
    explicit Matrix(std::size_t size) : size_(size), value_(size * size) {}

    std::size_t size() const { return size_; }
    double& at(std::size_t row, std::size_t column) { return value_[row * size_ + column]; }
    double at(std::size_t row, std::size_t column) const { return value_[row * size_ + column]; }

  private:
    std::size_t size_;
    std::vector<double> value_;
};

/// Whether a symmetric matrix is positive definite: whether Cholesky's factorisation goes through
/// to the end. Entries more than `band` off the diagonal are zero and stay so.
bool is_positive_definite(Matrix m, std::size_t band);

} // namespace mane
