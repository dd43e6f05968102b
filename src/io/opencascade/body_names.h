#pragma once

#include <StepData_StepModel.hxx>
#include <TopoDS_Shape.hxx>
#include <Transfer_TransientProcess.hxx>
#include <string>
#include <unordered_map>

namespace asdfvk {

/// The names of the bodies of a STEP file: the name of the representation item that is the body, for example of a
/// MANIFOLD_SOLID_BREP, or else of the item or the product around it.
class BodyNames {
 public:
  /// process: has transferred the entities of the model.
  void read(const Handle(StepData_StepModel) & model, const Handle(Transfer_TransientProcess) & process);
  /// Names the bodies of a shape that was transferred.
  void addRoot(const TopoDS_Shape& root) { addShape(root, nullptr); }
  /// Empty if the body has no name.
  [[nodiscard]] const char* of(const TopoDS_Shape& body) const;

 private:
  void addShape(const TopoDS_Shape& shape, const std::string* outerName);

  // The keys are TopoDS_Shape::TShape().
  std::unordered_map<const void*, std::string> itemNames_;     ///< Names of items and products.
  std::unordered_map<const void*, const std::string*> names_;  ///< By bodies and compounds; null without a name.
};

}  // namespace asdfvk
