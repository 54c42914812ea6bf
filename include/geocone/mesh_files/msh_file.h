// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_files_msh_file_h
#define geocone_mesh_files_msh_file_h

#include <geocone/base/types.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/set.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Mesh in gmsh's data model: nodes, elements and physical groups. The mesh is
   * read from a .msh file or from a model of the gmsh library. Elements are
   * linear: lines, triangles and quadrilaterals, and in three dimensions
   * tetrahedra and hexahedra. Quadratic elements with straight edges are
   * reduced to their corner nodes. Cells have the dimension of the scene, faces
   * one less.
   */
  struct MshData
  {
    /** Supported element types, with the type numbers of gmsh. */
    enum Type
    {
      line          = 1,
      triangle      = 2,
      quadrilateral = 3,
      tetrahedron   = 4,
      hexahedron    = 5,
      point         = 15
    };

    struct Node
    {
      std::uint64_t         tag;
      std::array<double, 3> x;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &tag &x;
      }
    };

    struct Element
    {
      std::uint64_t tag;
      int           type;
      /** Tag of the geometric entity (curve, surface or volume) that contains
       *  the element. */
      int entity;
      /** Index in #group_lists of the list of physical groups to which the
       *  element belongs. */
      unsigned int groups;
      /** Node tags of the element, padded with zeros. */
      std::array<std::uint64_t, 8> nodes;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &tag &type &entity &groups &nodes;
      }
    };

    /**
     * Index in #group_lists of a given list of physical groups. A new list is
     * appended.
     */
    unsigned int
    index_of_groups(const std::vector<int> &groups);

    std::vector<Node>    nodes;
    std::vector<Element> cells, faces;

    /** Distinct lists of physical groups (numbers > 0) to which elements
     *  belong. */
    std::vector<std::vector<int>> group_lists = {{}};

    /** Physical group numbers of the boundary faces (curves or surfaces). */
    std::set<int> face_groups;

    /** Names of the physical groups of faces and of cells, by group number. */
    std::map<int, std::string> face_names, cell_names;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &nodes &cells &faces &group_lists &face_groups &face_names
        &cell_names &index_of_list;
    }

  private:
    std::map<std::vector<int>, unsigned int> index_of_list = {{{}, 0}};
  };

  /** Suggested remedy for a damaged .msh file, used in error messages. */
  inline const std::string msh_remedy =
    "write it anew, e.g.: gmsh OLD.msh -save -format msh41 -o NEW.msh";

  /** Names used by gmsh for boundary faces and for cell regions, for error
   *  messages. */
  const std::string face_word = dim == 2 ? "curve" : "surface";
  const std::string cell_word = dim == 2 ? "surface" : "volume";

  /** Number of corner nodes of a gmsh element type. The second function returns
   *  the dimension of the type. */
  unsigned int
  n_nodes_of_type(const int type);
  int
  dimension_of_type(const int type);

  /**
   * Checks that an element type of gmsh is supported. @throws InputError if it
   * is not, naming the mesh @p what and, if not empty, @p element
   */
  void
  check_element_type(const int          type,
                     const std::string &what,
                     const std::string &element);

  /**
   * Returns true if a text begins with the header of a .msh file. The first
   * section must be MeshFormat, possibly after comments.
   */
  bool
  begins_as_msh(const std::string &text);

  /**
   * Reads the content of a regular file, which may be binary.
   * @throws InputError if the file is not regular, cannot be read, or exceeds
   * 512 MB, the size of meshes with five million nodes
   */
  std::string
  content_of_file(const std::string &file_name, const std::string &what);

  /**
   * Parses a .msh file of version 2.2 or 4.1, ASCII or binary in either byte
   * order. The text is data: nothing in it is executed. Memory is bounded by a
   * multiple of the length of the text, whatever numbers the text contains.
   * Sections without nodes and elements are skipped.
   * @param what name of the mesh in error messages
   * @throws InputError with the line (of a binary file: the byte) if the text
   * has another version, is damaged or inconsistent, or contains elements other
   * than MshData's types
   */
  MshData
  parse_msh(const std::string &text, const std::string &what);
} // namespace geocone::GEOCONE_DIM

#endif
