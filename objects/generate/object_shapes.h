#pragma once
/** @file
Shapes of the 21 benchmark objects. The thesis gives their sizes, masses and friction (table 4.1)
but not their geometry: these shapes are modelled on real objects of the same name and size.

Each function draws one object as it rests on the table, with z up and its length along x, in
millimetres. Its size is approximate: the generator scales it to the size in object.yaml. */

#include <filesystem>
#include <string>

#include "core/shape/tri_mesh.h"

namespace graspbench {

TriMesh DrawAdhesiveTape();
TriMesh DrawToyPropeller();
TriMesh DrawToyCube();
TriMesh DrawCan();
TriMesh DrawTissuePack();
TriMesh DrawTennisBall();
TriMesh DrawPaperBall();
TriMesh DrawSharpener();
TriMesh DrawRemoteControl();
TriMesh DrawCup();
TriMesh DrawBoardMarker();
TriMesh DrawTeaLight();
TriMesh DrawGolfBall();
TriMesh DrawMatchbox();
TriMesh DrawLightBulb();
TriMesh DrawChocolateBar();
TriMesh DrawFoldingRule();
TriMesh DrawVoltageTester();
TriMesh DrawEraser();
TriMesh DrawBunchOfKeys();
TriMesh DrawPencil();

/** Draws the mesh of a catalogue object, scaled exactly to `size` [m], with its bounding box
centred at O. @throws Error(kNotFound) for an id without a drawing function. */
TriMesh GenerateMesh(const std::string& id, const Eigen::Vector3d& size);

/** Writes `FOLDER/ID/mesh.obj` for every object, with the size in `FOLDER/ID/object.yaml`. */
void GenerateMeshes(const std::filesystem::path& folder);

}  // namespace graspbench
