// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/scene_mesh.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "drivers/frame_source.hpp"

namespace geomap::drivers {

Mesh read_mesh(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  const bool is_glb = extension == ".glb";
  // Nothing else: assimp crashes on PLY files that it wrote itself.
  if (!is_glb && extension != ".obj") {
    throw SourceError(file.string() + ": a mesh is an .obj or a .glb file");
  }
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                           aiProcess_JoinIdenticalVertices);
  if (scene == nullptr) throw SourceError(file.string() + ": " + importer.GetErrorString());

  Mesh mesh;
  for (unsigned int m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (unsigned int i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D& p = part.mVertices[i];
      mesh.vertices.emplace_back(p.x, is_glb ? -p.z : p.y, is_glb ? p.y : p.z);
      if (!mesh.vertices.back().allFinite()) {
        throw SourceError(file.string() + ": a vertex is not finite");
      }
    }
    for (unsigned int i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      mesh.triangles.push_back(
          {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
  }
  if (mesh.triangles.empty()) throw SourceError(file.string() + ": holds no triangles");
  return mesh;
}

}  // namespace geomap::drivers
