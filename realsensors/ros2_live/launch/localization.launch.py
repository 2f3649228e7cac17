"""Nav2's localization with Ortung in amcl's place, for Humble, Jazzy and later: map_server, ortung-ros2, and the lifecycle manager of both.

    ros2 launch localization.launch.py map:=hall.yaml params_file:=nav2_params.yaml

It stands in for localization_launch.py of nav2_bringup, and goes with its navigation_launch.py.
"""
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    params_file = LaunchConfiguration("params_file")
    use_sim_time = LaunchConfiguration("use_sim_time")
    return LaunchDescription([
        DeclareLaunchArgument("map", description="YAML of the map"),
        DeclareLaunchArgument("params_file", description="parameters of Nav2; those of its amcl count"),
        DeclareLaunchArgument("use_sim_time", default_value="false"),
        DeclareLaunchArgument("belief", default_value="/var/tmp/ortung.belief", description="where the robot was last, kept over restarts"),
        Node(package="nav2_map_server", executable="map_server", name="map_server", output="screen",
             parameters=[params_file, {"yaml_filename": LaunchConfiguration("map"), "use_sim_time": use_sim_time}]),
        ExecuteProcess(cmd=["ortung-ros2", "--belief", LaunchConfiguration("belief"),
                            "--ros-args", "-r", "__node:=amcl", "--params-file", params_file],
                       output="screen"),
        Node(package="nav2_lifecycle_manager", executable="lifecycle_manager", name="lifecycle_manager_localization", output="screen",
             parameters=[{"use_sim_time": use_sim_time, "autostart": True, "node_names": ["map_server", "amcl"]}]),
    ])
