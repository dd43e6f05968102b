#include "io/opencascade/body_names.h"

#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>

namespace asdfvk {
namespace {

/// Returns "" for the texts that programs write if there is no name: NONE, and a text with a number of Open CASCADE.
std::string textOf(const Handle(TCollection_HAsciiString) & name) {
  const std::string text = name.IsNull() ? "" : name->ToCString();
  return text == "NONE" || text.starts_with("Open CASCADE STEP translator ") ? "" : text;
}

/// Empty for an entity that names no shape. A mapped item is an instance of a shape, which may have further instances.
std::string itemNameOf(const Handle(Standard_Transient) & entity) {
  const Handle(StepRepr_RepresentationItem) item = Handle(StepRepr_RepresentationItem)::DownCast(entity);
  return item.IsNull() || item->IsKind(STANDARD_TYPE(StepRepr_MappedItem)) ? "" : textOf(item->Name());
}

std::string productNameOf(const Handle(Standard_Transient) & entity) {
  const Handle(StepBasic_ProductDefinition) definition = Handle(StepBasic_ProductDefinition)::DownCast(entity);
  if (definition.IsNull() || definition->Formation().IsNull() || definition->Formation()->OfProduct().IsNull())
    return "";
  const Handle(StepBasic_Product) product = definition->Formation()->OfProduct();
  const std::string name = textOf(product->Name());
  return name.empty() ? textOf(product->Id()) : name;
}

}  // namespace

void BodyNames::read(const Handle(StepData_StepModel) & model, const Handle(Transfer_TransientProcess) & process) {
  // Items are first, because the shape of a product can be the body itself.
  for (const auto nameOf : {itemNameOf, productNameOf})
    for (int i = 1; i <= model->NbEntities(); ++i) {
      const Handle(Standard_Transient) entity = model->Value(i);
      const std::string name = nameOf(entity);
      if (name.empty()) continue;
      const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
      if (!shape.IsNull() && shape.ShapeType() <= TopAbs_FACE) itemNames_.try_emplace(shape.TShape().get(), name);
    }
}

const char* BodyNames::of(const TopoDS_Shape& body) const {
  const auto found = names_.find(body.TShape().get());
  return found == names_.end() || found->second == nullptr ? "" : found->second->c_str();
}

/// Follows a compound of several instances once.
void BodyNames::addShape(const TopoDS_Shape& shape, const std::string* outerName) {
  const auto own = itemNames_.find(shape.TShape().get());
  const std::string* const name = own == itemNames_.end() ? outerName : &own->second;
  if (!names_.try_emplace(shape.TShape().get(), name).second || shape.ShapeType() > TopAbs_COMPSOLID) return;
  for (TopoDS_Iterator child(shape); child.More(); child.Next()) addShape(child.Value(), name);
}

}  // namespace asdfvk
