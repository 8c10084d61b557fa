#pragma once
/** @file
The shapes of the 21 objects of the benchmark. The thesis gives their sizes, masses and friction
(table 4.1), not their geometry: the shapes are ours, drawn after things of that name and size.

Each function draws one object as it rests on the table, z up, length along x, in millimetres and
only roughly of the right size: the generator fits it to the size in object.yaml. */

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

/** Draws the catalogue's meshes; see main.cc. The drawn shape of a catalogue object, exactly of
`size` [m], its bounding box centred at O. @throws Error(kNotFound) for an id that has no drawing.
*/
TriMesh GenerateMesh(const std::string& id, const Eigen::Vector3d& size);

/** Writes `FOLDER/ID/mesh.obj` for every drawing, sized by `FOLDER/ID/object.yaml`. */
void GenerateMeshes(const std::filesystem::path& folder);

}  // namespace graspbench
