// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Basic Model Interface 2.0 of CSDMS (doi:10.21105/joss.02317) to a delos component. C++17.
//
//   delos::Bmi model;                       // or delos::BmiModel<bmi::Bmi>, with CSDMS's bmi.hxx
//   model.Initialize("world_ocean.yaml");   // makes the grid
//   model.GetValue("cell_area", area_m2.data());
//   model.UpdateUntil(864000.0);
//   model.Finalize();
//
// Grid 0 is the grid: unstructured, rank 2, nodes are the Voronoi cells' corners (x longitude, y
// latitude, degrees), faces are the cells, ids from 0. Grid 1 is a scalar, of grid__generation.
// Outputs are the component's exports by name, on faces, and grid__generation; inputs its imports.
// Every failure throws a std::runtime_error (a delos::Error) that says what to do.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "delos/export.hpp"

namespace delos::api {

// The names are BMI's.
// NOLINTBEGIN(readability-identifier-naming)

/// The 41 functions of BMI 2.0, for hosts without CSDMS's bmi.hxx. In that file's order, so that a
/// framework that was compiled with it finds each function at its place in the virtual table.
class BmiInterface {
 public:
  virtual ~BmiInterface() = default;

  virtual void Initialize(std::string config_file) = 0;
  virtual void Update() = 0;
  virtual void UpdateUntil(double time) = 0;
  virtual void Finalize() = 0;

  virtual std::string GetComponentName() = 0;
  virtual int GetInputItemCount() = 0;
  virtual int GetOutputItemCount() = 0;
  virtual std::vector<std::string> GetInputVarNames() = 0;
  virtual std::vector<std::string> GetOutputVarNames() = 0;

  virtual int GetVarGrid(std::string name) = 0;
  virtual std::string GetVarType(std::string name) = 0;
  virtual std::string GetVarUnits(std::string name) = 0;
  virtual int GetVarItemsize(std::string name) = 0;
  virtual int GetVarNbytes(std::string name) = 0;
  virtual std::string GetVarLocation(std::string name) = 0;

  virtual double GetCurrentTime() = 0;
  virtual double GetStartTime() = 0;
  virtual double GetEndTime() = 0;
  virtual std::string GetTimeUnits() = 0;
  virtual double GetTimeStep() = 0;

  virtual void GetValue(std::string name, void* dest) = 0;
  virtual void* GetValuePtr(std::string name) = 0;
  virtual void GetValueAtIndices(std::string name, void* dest, int* inds, int count) = 0;
  virtual void SetValue(std::string name, void* src) = 0;
  virtual void SetValueAtIndices(std::string name, int* inds, int count, void* src) = 0;

  virtual int GetGridRank(const int grid) = 0;
  virtual int GetGridSize(const int grid) = 0;
  virtual std::string GetGridType(const int grid) = 0;
  virtual void GetGridShape(const int grid, int* shape) = 0;
  virtual void GetGridSpacing(const int grid, double* spacing) = 0;
  virtual void GetGridOrigin(const int grid, double* origin) = 0;
  virtual void GetGridX(const int grid, double* x) = 0;
  virtual void GetGridY(const int grid, double* y) = 0;
  virtual void GetGridZ(const int grid, double* z) = 0;
  virtual int GetGridNodeCount(const int grid) = 0;
  virtual int GetGridEdgeCount(const int grid) = 0;
  virtual int GetGridFaceCount(const int grid) = 0;
  virtual void GetGridEdgeNodes(const int grid, int* edge_nodes) = 0;
  virtual void GetGridFaceEdges(const int grid, int* face_edges) = 0;
  virtual void GetGridFaceNodes(const int grid, int* face_nodes) = 0;
  virtual void GetGridNodesPerFace(const int grid, int* nodes_per_face) = 0;
};

/// What the 41 functions do, one for one. Not for hosts: it keeps BmiModel a list of calls.
class DELOS_API BmiBackend {
 public:
  BmiBackend();
  BmiBackend(const BmiBackend&) = delete;
  BmiBackend& operator=(const BmiBackend&) = delete;
  ~BmiBackend();

  void initialize(const std::string& config_file);
  void update();
  void update_until(double time_s);
  void finalize();

  std::vector<std::string> input_names() const;
  std::vector<std::string> output_names() const;
  int var_grid(const std::string& name) const;
  std::string var_type(const std::string& name) const;
  std::string var_units(const std::string& name) const;
  int var_itemsize(const std::string& name) const;
  int var_nbytes(const std::string& name) const;
  std::string var_location(const std::string& name) const;

  double current_time_s() const;
  double start_time_s() const;
  double end_time_s() const;
  double time_step_s() const;

  void get(const std::string& name, void* dest) const;
  void get_at(const std::string& name, void* dest, const int* indices, int count) const;
  void* pointer(const std::string& name);
  void set(const std::string& name, const void* source);
  void set_at(const std::string& name, const int* indices, int count, const void* source);

  int grid_rank(int grid) const;
  int grid_size(int grid) const;
  std::string grid_type(int grid) const;
  /// Throws: no grid here is rectilinear.
  void refuse_structured(int grid, const char* what) const;
  void grid_x(int grid, double* x) const;
  void grid_y(int grid, double* y) const;
  void refuse_z(int grid) const;
  int node_count(int grid) const;
  int edge_count(int grid) const;
  int face_count(int grid) const;
  void edge_nodes(int grid, int* nodes) const;
  void face_edges(int grid, int* edges) const;
  void face_nodes(int grid, int* nodes) const;
  void nodes_per_face(int grid, int* counts) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A model of one component, under the abstract class that the framework knows: BmiInterface, or
/// bmi::Bmi of CSDMS's bmi.hxx (include that first).
///
/// Time is in seconds since Initialize and has no end. BMI has no way to say that the grid changed:
/// when grid__generation has grown after an Update, ask for sizes, coordinates, tables and pointers
/// again, and set the inputs anew. It grows from one Initialize to the next, too. Inputs never set
/// are absent, and values never set of an input are NaN. A pointer to an output is for reading; one
/// to an input may be written to. Both hold until the next generation, Finalize or the model's end.
template <class Interface>
class BmiModel : public Interface {
 public:
  void Initialize(std::string config_file) override { backend_.initialize(config_file); }
  void Update() override { backend_.update(); }
  void UpdateUntil(double time) override { backend_.update_until(time); }
  /// Gives the grid back; Initialize may follow. Does nothing where there is no grid.
  void Finalize() override { backend_.finalize(); }

  std::string GetComponentName() override { return "delos"; }
  int GetInputItemCount() override { return static_cast<int>(backend_.input_names().size()); }
  int GetOutputItemCount() override { return static_cast<int>(backend_.output_names().size()); }
  std::vector<std::string> GetInputVarNames() override { return backend_.input_names(); }
  std::vector<std::string> GetOutputVarNames() override { return backend_.output_names(); }

  int GetVarGrid(std::string name) override { return backend_.var_grid(name); }
  /// "double", or "int" for grid__generation.
  std::string GetVarType(std::string name) override { return backend_.var_type(name); }
  /// As UDUNITS reads them.
  std::string GetVarUnits(std::string name) override { return backend_.var_units(name); }
  int GetVarItemsize(std::string name) override { return backend_.var_itemsize(name); }
  int GetVarNbytes(std::string name) override { return backend_.var_nbytes(name); }
  /// "face"; "node" for grid__generation.
  std::string GetVarLocation(std::string name) override { return backend_.var_location(name); }

  double GetCurrentTime() override { return backend_.current_time_s(); }
  double GetStartTime() override { return backend_.start_time_s(); }
  /// The largest double: the component has no end of its own.
  double GetEndTime() override { return backend_.end_time_s(); }
  std::string GetTimeUnits() override { return "s"; }
  /// Of Update: a day.
  double GetTimeStep() override { return backend_.time_step_s(); }

  void GetValue(std::string name, void* dest) override { backend_.get(name, dest); }
  void* GetValuePtr(std::string name) override { return backend_.pointer(name); }
  void GetValueAtIndices(std::string name, void* dest, int* inds, int count) override {
    backend_.get_at(name, dest, inds, count);
  }
  void SetValue(std::string name, void* src) override { backend_.set(name, src); }
  void SetValueAtIndices(std::string name, int* inds, int count, void* src) override {
    backend_.set_at(name, inds, count, src);
  }

  int GetGridRank(const int grid) override { return backend_.grid_rank(grid); }
  /// Nodes.
  int GetGridSize(const int grid) override { return backend_.grid_size(grid); }
  std::string GetGridType(const int grid) override { return backend_.grid_type(grid); }
  void GetGridShape(const int grid, int* /*shape*/) override {
    backend_.refuse_structured(grid, "shape");
  }
  void GetGridSpacing(const int grid, double* /*spacing*/) override {
    backend_.refuse_structured(grid, "spacing");
  }
  void GetGridOrigin(const int grid, double* /*origin*/) override {
    backend_.refuse_structured(grid, "origin");
  }
  /// [n_nodes] longitude, [0, 360] degrees.
  void GetGridX(const int grid, double* x) override { backend_.grid_x(grid, x); }
  /// [n_nodes] latitude, of the configured kind, degrees.
  void GetGridY(const int grid, double* y) override { backend_.grid_y(grid, y); }
  /// Throws: the rank is 2.
  void GetGridZ(const int grid, double* /*z*/) override { backend_.refuse_z(grid); }
  int GetGridNodeCount(const int grid) override { return backend_.node_count(grid); }
  int GetGridEdgeCount(const int grid) override { return backend_.edge_count(grid); }
  int GetGridFaceCount(const int grid) override { return backend_.face_count(grid); }
  /// [n_edges, 2]
  void GetGridEdgeNodes(const int grid, int* edge_nodes) override {
    backend_.edge_nodes(grid, edge_nodes);
  }
  /// Face after face, counter-clockwise; the j-th edge of a face joins its nodes j - 1 and j.
  void GetGridFaceEdges(const int grid, int* face_edges) override {
    backend_.face_edges(grid, face_edges);
  }
  /// Face after face, counter-clockwise.
  void GetGridFaceNodes(const int grid, int* face_nodes) override {
    backend_.face_nodes(grid, face_nodes);
  }
  /// [n_faces]
  void GetGridNodesPerFace(const int grid, int* nodes_per_face) override {
    backend_.nodes_per_face(grid, nodes_per_face);
  }

 private:
  BmiBackend backend_;
};

using Bmi = BmiModel<BmiInterface>;

// NOLINTEND(readability-identifier-naming)

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::Bmi;
using api::BmiInterface;
using api::BmiModel;
}  // namespace delos
#endif
