// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FieldSampler.h"

#include "TSpline/InverseJacobian.h"

#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>

namespace trivariate
{
namespace
{
// Points evaluated at a time: bounds the buffers, and how long the user waits to be heard.
constexpr Index Stride = 1 << 18;

vtkSmartPointer<vtkDoubleArray> MakeArray(const std::string& name, int components)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  return array;
}
}

// What the evaluator writes, for some points at a time.
struct FieldSampler::Buffers
{
  std::vector<double> Values, Gradients;
  EvaluatorOutput Output;

  Buffers(const FieldSampler& sampler, Index points)
    : Values(sampler.Spline->Components() * points)
    , Gradients(sampler.Differentiates ? 3 * Values.size() : 0)
  {
    this->Output.Values = this->Values.data();
    this->Output.Gradients = sampler.Differentiates ? this->Gradients.data() : nullptr;
  }
};

FieldSampler::FieldSampler(const TSplineView& view, bool positions, const Execution& execution)
  : Differentiates(view.Gradients || view.Jacobian)
{
  const TSplineModel& model = view.Model;
  const bool geometry = positions || this->Differentiates || model.Attributes.empty();
  std::vector<int> components;
  for (int c = geometry ? 0 : 3; c < model.Spline.Components; ++c)
  {
    components.push_back(c);
  }
  this->Spline = std::make_unique<Evaluator>(model.Spline, view.Mesh, components, execution);

  if (positions)
  {
    this->Positions = MakeArray("Points", 3);
  }
  if (view.Jacobian)
  {
    this->Jacobian = MakeArray("JacobianDeterminant", 1);
  }
  int next = geometry ? 3 : 0;
  for (const TSplineAttribute& attribute : model.Attributes)
  {
    Attribute target{ next, MakeArray(attribute.Name, attribute.Components), nullptr };
    if (view.Gradients)
    {
      target.Gradient = MakeArray(attribute.Name + "Gradient", 3 * attribute.Components);
    }
    this->Attributes.push_back(target);
    next += attribute.Components;
  }
}

double FieldSampler::BytesPerPoint() const
{
  double numbers = (this->Positions ? 3.0 : 0.0) + (this->Jacobian ? 1.0 : 0.0);
  for (const Attribute& attribute : this->Attributes)
  {
    numbers += attribute.Values->GetNumberOfComponents() * (attribute.Gradient ? 4.0 : 1.0);
  }
  return numbers * sizeof(double);
}

void FieldSampler::Allocate(Index n)
{
  for (vtkDoubleArray* array : { this->Positions.Get(), this->Jacobian.Get() })
  {
    if (array)
    {
      array->SetNumberOfTuples(n);
    }
  }
  for (const Attribute& attribute : this->Attributes)
  {
    attribute.Values->SetNumberOfTuples(n);
    if (attribute.Gradient)
    {
      attribute.Gradient->SetNumberOfTuples(n);
    }
  }
}

void FieldSampler::ScatterPoint(Index point, const double* values, const double* gradients) const
{
  if (this->Positions)
  {
    std::copy_n(values, 3, this->Positions->GetPointer(3 * point));
  }
  for (const Attribute& attribute : this->Attributes)
  {
    const int count = attribute.Values->GetNumberOfComponents();
    std::copy_n(values + attribute.First, count, attribute.Values->GetPointer(count * point));
  }
  if (!gradients)
  {
    return;
  }
  const InverseJacobian jacobian(gradients);
  if (this->Jacobian)
  {
    this->Jacobian->SetValue(point, jacobian.Determinant);
  }
  for (const Attribute& attribute : this->Attributes)
  {
    if (!attribute.Gradient)
    {
      continue;
    }
    const int count = attribute.Values->GetNumberOfComponents();
    double* target = attribute.Gradient->GetPointer(3 * count * point);
    for (int c = 0; c < count; ++c)
    {
      const auto gradient = jacobian.Gradient(gradients + 3 * (attribute.First + c));
      std::copy_n(gradient.data(), 3, target + 3 * c);
    }
  }
}

void FieldSampler::Scatter(Index first, Index n, const EvaluatorOutput& source,
  const std::uint8_t* found, const Execution& execution) const
{
  const int components = this->Spline->Components();
  const std::vector<double> zeros(3 * components, 0.0);
  execution.ParallelFor(n,
    [this, first, &source, found, components, &zeros](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        const bool here = !found || found[i];
        const double* values = here ? source.Values + i * components : zeros.data();
        const double* gradients =
          here && source.Gradients ? source.Gradients + 3 * i * components : zeros.data();
        this->ScatterPoint(first + i, values, this->Differentiates ? gradients : nullptr);
      }
    });
}

void FieldSampler::Sample(Index first, Index n, const double* parameters, const std::uint8_t* found,
  const Execution& execution)
{
  Buffers buffers(*this, std::min(n, Stride));
  for (Index done = 0; done < n; done += Stride)
  {
    const Index count = std::min(Stride, n - done);
    this->Spline->Evaluate(count, parameters + 3 * done, buffers.Output,
      execution.Part(1.0 * done / n, 1.0 * (done + count) / n));
    this->Scatter(first + done, count, buffers.Output, found ? found + done : nullptr, execution);
  }
}

void FieldSampler::SampleLattice(const std::array<std::vector<double>, 3>& coordinates,
  std::uint8_t* inside, const Execution& execution)
{
  const Index layer = static_cast<Index>(coordinates[0].size() * coordinates[1].size());
  const Index layers = static_cast<Index>(coordinates[2].size());
  const Index stride = std::min(layers, std::max<Index>(1, 4 * Stride / layer));
  Buffers buffers(*this, stride * layer);
  for (Index done = 0; done < layers; done += stride)
  {
    const Index count = std::min(stride, layers - done);
    const auto ws = coordinates[2].begin() + done;
    buffers.Output.Inside = inside + done * layer;
    this->Spline->EvaluateLattice(
      { coordinates[0], coordinates[1], std::vector<double>(ws, ws + count) }, buffers.Output,
      execution.Part(1.0 * done / layers, 1.0 * (done + count) / layers));
    this->Scatter(done * layer, count * layer, buffers.Output, buffers.Output.Inside, execution);
  }
}

void FieldSampler::AddTo(vtkPointData* pointData, vtkPoints* points) const
{
  if (points)
  {
    points->SetData(this->Positions);
  }
  for (const Attribute& attribute : this->Attributes)
  {
    pointData->AddArray(attribute.Values);
    if (attribute.Gradient)
    {
      pointData->AddArray(attribute.Gradient);
    }
  }
  if (this->Jacobian)
  {
    pointData->AddArray(this->Jacobian);
  }
  if (!this->Attributes.empty())
  {
    pointData->SetActiveScalars(this->Attributes.front().Values->GetName());
  }
}
}
