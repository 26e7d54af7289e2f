# The procedures of a robot below a temporal plan (plans/laas.yaml).

connect
foreach module {rflex sick segloc pom ndd} { lm $module }

set tries_max 3

# A procedure of the plan: drives to a point, by another route if the way is blocked. A request takes at most 48 points.
proc visit {x y} {
  for {set try 0} {$try < $::tries_max} {incr try} {
    set route [waitpoint::plan $x $y]
    try {
      for {set i 0} {$i < [llength $route]} {incr i 48} { ndd::GoTo [lrange $route $i $i+47] }
      return
    } trap {WAITPOINT REPORT} message {
      puts $message
      waitpoint::look
      waitpoint::mark
    }
  }
  error "the way stays blocked"
}

# A procedure of the plan: the safe state.
proc halt {} {
  ndd::Stop
  rflex::Stop
  sick::Stop
}

set pose [waitpoint::start]
rflex::SetPos $pose
pom::SetPos $pose
sick::ContinuousShot -async
segloc::Localise -async $pose
rflex::TrackSpeedStart -async
