#pragma once

// Eigen's sparse matrices and solvers. As a system header, so that warnings in Eigen's templates do
// not fail the build.
#pragma GCC system_header

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
