// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_msh_file_h
#define geocone_mesh_msh_file_h

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
   * Nodes, elements and physical groups in gmsh's terms, from a .msh file or a
   * model of the gmsh library. Elements are linear: lines, triangles and
   * quadrilaterals, and in three dimensions tetrahedra and hexahedra. Of
   * quadratic elements with straight edges the corners are kept. Cells have
   * the dimension of the scene, faces one less.
   */
  struct MshData
  {
    /** gmsh's numbers of the supported element types. */
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
      /** The curve, surface or volume of the element. */
      int entity;
      /** Index into #group_lists. */
      unsigned int groups;
      /** Tags of the nodes, followed by zeros. */
      std::array<std::uint64_t, 8> nodes;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &tag &type &entity &groups &nodes;
      }
    };

    /**
     * Index of a list of physical groups in #group_lists; new lists are added.
     */
    unsigned int
    index_of_groups(const std::vector<int> &groups);

    std::vector<Node>    nodes;
    std::vector<Element> cells, faces;

    /** Lists of physical groups (numbers > 0) of elements. */
    std::vector<std::vector<int>> group_lists = {{}};

    /** The physical groups of faces: curves, or surfaces. */
    std::set<int> face_groups;

    /** Names of face groups by number, and those of cell groups. */
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

  /** Remedy for a damaged file. */
  inline const std::string msh_remedy =
    "write it anew, e.g.: gmsh OLD.msh -save -format msh41 -o NEW.msh";

  /** gmsh's words for the faces of cells, and for regions of cells. */
  const std::string face_word = dim == 2 ? "curve" : "surface";
  const std::string cell_word = dim == 2 ? "surface" : "volume";

  /** Number of corners of an element type of MshData, and its dimension. */
  unsigned int
  n_nodes_of_type(const int type);
  int
  dimension_of_type(const int type);

  /**
   * @throws InputError if elements of gmsh's @p type are not supported; @p what
   * names the mesh, and @p element, which can be empty, the element
   */
  void
  check_element_type(const int          type,
                     const std::string &what,
                     const std::string &element);

  /**
   * Whether a text begins like a .msh file: with the section MeshFormat,
   * possibly after comments.
   */
  bool
  begins_as_msh(const std::string &text);

  /**
   * Content of a regular file, possibly binary.
   * @throws InputError if it is not a regular file, cannot be read, or exceeds
   * 512 MB, the size of meshes with five million nodes
   */
  std::string
  content_of_file(const std::string &file_name, const std::string &what);

  /**
   * Parses a .msh file of version 2.2 or 4.1, ASCII or binary in either byte
   * order. It is data: nothing in it is executed. Memory is bounded by a
   * multiple of the length of the text, whatever numbers it contains. Sections
   * without nodes and elements are skipped.
   * @param what name of the mesh in error messages
   * @throws InputError with the line (of a binary file: the byte) if the text
   * has another version, is damaged or inconsistent, or contains elements other
   * than MshData's types
   */
  MshData
  parse_msh(const std::string &text, const std::string &what);
} // namespace geocone::GEOCONE_DIM

#endif
