"""Nav2's localization in a building of several floors, for Humble, Jazzy and later: ortung-ros2, which has the maps itself and tells that of the
robot's floor, so without map_server, and the lifecycle manager.

    ros2 launch floors.launch.py world:=building.toml params_file:=nav2_params.yaml

It stands in for localization_launch.py of nav2_bringup, and goes with its navigation_launch.py.
"""
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    params_file = LaunchConfiguration("params_file")
    return LaunchDescription([
        DeclareLaunchArgument("world", description="world file (TOML) of the building"),
        DeclareLaunchArgument("params_file", description="parameters of Nav2; those of its amcl count"),
        DeclareLaunchArgument("use_sim_time", default_value="false"),
        DeclareLaunchArgument("belief", default_value="/var/tmp/ortung.belief", description="where the robot was last, kept over restarts"),
        ExecuteProcess(cmd=["ortung-ros2", "--world", LaunchConfiguration("world"), "--belief", LaunchConfiguration("belief"),
                            "--ros-args", "-r", "__node:=amcl", "--params-file", params_file],
                       output="screen"),
        Node(package="nav2_lifecycle_manager", executable="lifecycle_manager", name="lifecycle_manager_localization", output="screen",
             parameters=[{"use_sim_time": LaunchConfiguration("use_sim_time"), "autostart": True, "node_names": ["amcl"]}]),
    ])
