program run_tests
  use check, only: finish
  use test_linalg, only: run_linalg_tests
  use test_linalg_band, only: run_linalg_band_tests
  use test_section_data, only: run_section_data_tests
  use test_section_plates, only: run_section_plates_tests
  use test_section_shapes, only: run_section_shapes_tests
  use test_section_solids, only: run_section_solids_tests
  use test_section_topology, only: run_section_topology_tests
  use test_section_check, only: run_section_check_tests
  use test_deck_form, only: run_deck_form_tests
  use test_deck_model, only: run_deck_model_tests
  use test_deck_joints, only: run_deck_joints_tests
  use test_deck_wrong, only: run_deck_wrong_tests
  use test_formula_derivatives, only: run_formula_derivatives_tests
  use test_deck_analyses, only: run_deck_analyses_tests
  use test_model_axes, only: run_model_axes_tests
  use test_element_beamw, only: run_element_beamw_tests
  use test_element_joints, only: run_element_joints_tests
  use test_joint_motions, only: run_joint_motions_tests
  use test_slider, only: run_slider_tests
  use test_slider_motions, only: run_slider_motions_tests
  use test_beamw_inertia, only: run_beamw_inertia_tests
  use test_inertia_tangent, only: run_inertia_tangent_tests
  use test_rotating_inertia, only: run_rotating_inertia_tests
  use test_check, only: run_check_tests
  use test_run_log, only: run_log_tests
  use test_column_vibration, only: run_column_vibration_tests
  use test_static, only: run_static_tests
  use test_dead_loads, only: run_dead_loads_tests
  use test_start_assembly, only: run_start_assembly_tests
  use test_start_velocity, only: run_start_velocity_tests
  use test_singular_start, only: run_singular_start_tests
  use test_limits, only: run_limits_tests
  use test_path, only: run_path_tests
  use test_stability, only: run_stability_tests
  use test_linalg_eigen, only: run_linalg_eigen_tests
  use test_linalg_quadratic, only: run_linalg_quadratic_tests
  use test_buckling, only: run_buckling_tests
  use test_eigen, only: run_eigen_tests
  use test_transient_rigid, only: run_transient_rigid_tests
  use test_transient_flexible, only: run_transient_flexible_tests
  use test_transient_power, only: run_transient_power_tests
  use test_transient_start, only: run_transient_start_tests
  use test_transient_multipliers, only: run_transient_multipliers_tests
  use test_complex_modes, only: run_complex_modes_tests
  use test_eigen_matrices, only: run_eigen_matrices_tests
  use test_output_hdf5, only: run_output_hdf5_tests
  use test_output_modes, only: run_output_modes_tests
  use test_output_scales, only: run_output_scales_tests
  use test_output_results, only: run_output_results_tests
  use test_output_compare, only: run_output_compare_tests
  use test_mode_clusters, only: run_mode_clusters_tests
  use test_output_digest, only: run_output_digest_tests
  use test_output_vtkhdf, only: run_output_vtkhdf_tests
  use test_output_history, only: run_output_history_tests
  use test_output_drawn, only: run_output_drawn_tests
  use test_program, only: run_program_tests
  use test_restart, only: run_restart_tests
  use test_restart_refused, only: run_restart_refused_tests
  use test_deck_sections, only: run_deck_sections_tests
  use test_section_command, only: run_section_command_tests
  use test_manual, only: run_manual_tests
  use test_kinematic, only: run_kinematic_tests
  use test_spatial_mechanisms, only: run_spatial_mechanisms_tests
  use test_flexures, only: run_flexures_tests
  use test_driving_forces, only: run_driving_forces_tests
  use test_spacar_decks, only: run_spacar_decks_tests
  use test_inverse, only: run_inverse_tests
  use test_compliance, only: run_compliance_tests
  use test_motion_bridge, only: run_motion_bridge_tests
  implicit none

  call run_linalg_tests()
  call run_linalg_band_tests()
  call run_section_data_tests()
  call run_section_plates_tests()
  call run_section_shapes_tests()
  call run_section_solids_tests()
  call run_section_topology_tests()
  call run_section_check_tests()
  call run_deck_form_tests()
  call run_deck_model_tests()
  call run_deck_joints_tests()
  call run_deck_wrong_tests()
  call run_formula_derivatives_tests()
  call run_deck_analyses_tests()
  call run_model_axes_tests()
  call run_element_beamw_tests()
  call run_element_joints_tests()
  call run_joint_motions_tests()
  call run_slider_tests()
  call run_slider_motions_tests()
  call run_beamw_inertia_tests()
  call run_inertia_tangent_tests()
  call run_rotating_inertia_tests()
  call run_column_vibration_tests()
  call run_static_tests()
  call run_dead_loads_tests()
  call run_start_assembly_tests()
  call run_start_velocity_tests()
  call run_singular_start_tests()
  call run_limits_tests()
  call run_check_tests()
  call run_log_tests()
  call run_path_tests()
  call run_stability_tests()
  call run_linalg_eigen_tests()
  call run_linalg_quadratic_tests()
  call run_buckling_tests()
  call run_eigen_tests()
  call run_transient_rigid_tests()
  call run_transient_flexible_tests()
  call run_transient_power_tests()
  call run_transient_start_tests()
  call run_transient_multipliers_tests()
  call run_complex_modes_tests()
  call run_eigen_matrices_tests()
  call run_output_hdf5_tests()
  call run_output_modes_tests()
  call run_output_scales_tests()
  call run_output_results_tests()
  call run_output_compare_tests()
  call run_mode_clusters_tests()
  call run_output_digest_tests()
  call run_output_vtkhdf_tests()
  call run_output_history_tests()
  call run_output_drawn_tests()
  call run_program_tests()
  call run_restart_tests()
  call run_restart_refused_tests()
  call run_deck_sections_tests()
  call run_section_command_tests()
  call run_manual_tests()
  call run_kinematic_tests()
  call run_spatial_mechanisms_tests()
  call run_flexures_tests()
  call run_driving_forces_tests()
  call run_spacar_decks_tests()
  call run_inverse_tests()
  call run_compliance_tests()
  call run_motion_bridge_tests()
  call finish()
end program run_tests
