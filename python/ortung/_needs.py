"""What to say of a part that this computer lacks something for."""


def needs(what, thing, packages, why):
    """Returns the sentence. packages: Debian's, that have the thing; why: what went wrong."""
    return f"{what} need {thing}, on Debian 12: apt-get install {' '.join(packages)} ({why})"
