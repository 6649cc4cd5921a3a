# cmake -D whole=A.wasm -D first=B.wasm -D second=C.wasm -P brushfire_split.cmake: takes what an ordinary first picture does
# not need out of a module and into a second one. The first calls imports of the name "placeholder" in their place; once
# lib/module.js has made an instance of the second, they are in its table.
find_program(wasm_split wasm-split REQUIRED)
find_program(wasm_opt wasm-opt REQUIRED)
set(features --enable-simd --enable-exception-handling --enable-bulk-memory --enable-sign-ext --enable-mutable-globals
  --enable-nontrapping-float-to-int)

# By names of functions, as the linker has them. A call across goes through the table: no loop of a method that stays may
# make one. Nor may what is called across take or give vectors of lanes, which JavaScript cannot hand on the first time.
set(later
  in_double_doubles # windows of wide numbers, which few meshes need
  14carried_source Dijkstra PlanarFront # methods that are there for comparison,
  "(Marcher|MarchState|Rings|RingBuilder|LaneWriter|CornerUnfolder)IdE" # and marching in doubles
  "(march_part|build_rings|fill_regular_rings|unfold_corners)IdE" "(5march|receive_messages)I[^v]*EL[^v]*EdE" march_label_setting
  "(5march|receive_messages)I[^v]*ELb1EfE" # marching with labels of the nearest source: a call across for all of a solve
  5rtree NearestPoint from_lengths 13check_lengthsEv renumbered with_slits read_field read_csv "^__rem_pio2_large$"
  WalledRun brushfire3cut CutMesh Barriers # walls
  distances_within [mM]atri voronoi farthest signed_distance Shore Arrivals compare_fields certif log_map
  curved_isolines "Level(Triangle|Mesh)" corners_tell shorten straightest subdivi weld
  # Writers, and readers of what is not PLY, OBJ, OFF or STL.
  "[0-9]write_(ply|obj|off|stl|vt|csv|json|npy|svg|dxf|gl|gmsh|medit|gifti|freesurfer)"
  "[0-9]write_(mesh|field|lines|shortest|point|corners|float_point)" Drawing dxf svg TemporaryFile
  nlohmann [gG]ltf [jJ]son [xX]ml [gG]ifti "[vV]t[kpu]" [gG]msh [mM]edit [fF]reesurfer
  # expat and zlib, whose names are those of C.
  "^XML" "^(big2|little2|normal|utf8|ascii|latin1|unknown)_"
  "^(do|store|process|parse|report|get|set|copy|call|external|internal|entityValue|prolog|epilog|content)[A-Z]"
  "^(prologInit|epilogProcessor|contentProcessor|addBinding|lookup|defineAttribute|appendAttributeValue|poolGrow|dtd[A-Z])"
  "^(inflate|deflate|_tr_|build_(bl_)?tree|longest_match|compress_block|gz|crc32|adler32|send_|scan_tree|fill_window|init_block)"
  # The calls from JavaScript for all of these.
  "^(matrix|certify|log_map|voronoi|farthest|signed|compare|trace|cut|within|gradients|curves_write|path_along)_?"
  "^(mesh_write|mesh_weld|mesh_nearest|mesh_subdivided|mesh_from_lengths|path_shortened|field_read)")
list(JOIN later "|" later)
# What a first picture calls of these: it lets go of empty hands, and asks of what kind a file is.
set(first_of_them "^_GLOBAL__|^__wasm" # what runs at the start
  "^_ZNK?St3__2[0-9]+(__)?(shared_ptr|optional_destruct)" "[0-9]is_[a-z_]+E" xml_head)
list(JOIN first_of_them "|" first_of_them)

execute_process(COMMAND ${wasm_opt} ${features} ${whole} --print-function-map OUTPUT_VARIABLE map ERROR_QUIET
  COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^:\n]+\n" names "${map}")
list(TRANSFORM names STRIP)
list(FILTER names INCLUDE REGEX "${later}")
list(FILTER names EXCLUDE REGEX "${first_of_them}")
list(LENGTH names count)
if(count EQUAL 0)
  message(FATAL_ERROR "no function of ${whole} has a name of the second module's")
endif()
list(JOIN names "\n" names)
file(WRITE ${whole}.second.txt "${names}\n")
execute_process(COMMAND ${wasm_split} ${features} ${whole} --split-funcs=@${whole}.second.txt --export-prefix=%
  -o1 ${first} -o2 ${second} COMMAND_ERROR_IS_FATAL ANY)
foreach(module ${first} ${second})
  execute_process(COMMAND ${wasm_opt} ${features} --strip-debug --post-emscripten -Oz --low-memory-unused --zero-filled-memory
    ${module} -o ${module} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
