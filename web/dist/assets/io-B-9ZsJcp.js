import{C as e,S as t,a as n,d as r,h as i,l as a,m as o,o as s,p as c,r as l,s as u,u as d,w as f,x as p}from"./index-Qc_W3yad.js";import{t as m}from"./tab-lKZc--Iv.js";import{t as h}from"./axis-picker-BWtEly2K.js";var g=1e3,_=[`pin`,`axis`,`port`,`way`,`bytes`],v={ms:`ms`,volts:`V`,at:`s`,duration:`s`,pulses:`pulses`,load:`of pull-out torque`,rate:`0 to 1`},y=class extends m{static properties={...m.properties,faults:{state:!0},kinds:{state:!0},kind:{state:!0},problem:{state:!0}};#e=0;static styles=[c,f`
      .fields {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(110px, 1fr));
        gap: 8px;
      }
      .about {
        font-size: 13px;
        color: var(--muted);
      }
    `];constructor(){super(),this.faults=[],this.kinds=[],this.kind=``,this.problem=null}connectedCallback(){super.connectedCallback(),this.#t()}disconnectedCallback(){super.disconnectedCallback(),clearTimeout(this.#e)}async#t(){if(clearTimeout(this.#e),this.active&&!document.hidden)try{this.kinds.length===0&&(this.kinds=await this.api.faultKinds(),this.kind||=this.kinds[0]?.name??``),this.faults=await this.api.faults(this.device.name),this.problem=null}catch(e){this.problem=i(e)}this.isConnected&&(this.#e=window.setTimeout(()=>void this.#t(),g))}render(){let e=this.kinds.find(({name:e})=>e===this.kind),{name:n}=this.device;return t`
      <section class="panel stack" aria-label="Power and faults">
        <div class="row"><h2 class="grow">Power</h2>
          <button class="small" ?disabled=${!this.usable} title="Off and on again"
            @click=${()=>d(()=>this.api.powerCycle(n),`Switched off and on`)}>Power cycle</button>
          <button class="small danger" ?disabled=${!this.usable} title="What flash had not finished is lost" @click=${this.#n}>Power cut</button>
        </div>
        <h2>Faults on purpose</h2>
        ${this.problem?t`<p class="error-text">${this.problem}</p>`:p}
        ${this.#r()}
        ${e?this.#a(e):p}
      </section>
    `}async#n(){await a({heading:`Cut the power?`,text:`The controller starts again at once; what its flash was writing is lost or torn.`,yes:`Cut`,danger:!0})&&await d(()=>this.api.powerCut(this.device.name),`Power cut`)}#r(){return this.faults.length===0?t`<p class="muted">There is none.</p>`:t`
      <table aria-label="Faults">
        <thead><tr><th>Fault</th><th>With</th><th>State</th>
          <th><button class="small plain" ?disabled=${!this.usable}
            @click=${()=>this.#i(()=>this.api.clearFaults(this.device.name))}>Clear all</button></th></tr></thead>
        <tbody>
          ${this.faults.map(e=>{let{id:n,kind:r,state:i,...a}=e,o=Object.entries(a).map(([e,t])=>`${e} ${typeof t==`object`?JSON.stringify(t):String(t)}`);return t`
              <tr><td>${b(String(r))}</td><td>${o.join(`, `)}</td>
                <td><span class="badge ${i===`active`?`error`:`warn`}">${i}</span></td>
                <td><button class="small" ?disabled=${!this.usable} aria-label="Clear ${b(String(r))}"
                  @click=${()=>this.#i(()=>this.api.clearFault(this.device.name,n))}>Clear</button></td></tr>`})}
        </tbody>
      </table>
    `}async#i(e){await d(e),await this.#t()}#a(e){let n=[`at`,...e.lasts?[`duration`]:[]];return t`
      <form class="stack" @submit=${this.#c}>
        <label>Kind
          <select @change=${e=>this.kind=e.target.value}>
            ${this.kinds.map(({name:e})=>t`<option value=${e} ?selected=${e===this.kind}>${b(e)}</option>`)}
          </select>
        </label>
        <p class="about">${e.text.split("`").map((e,n)=>n%2==0?e:t`<code>${e}</code>`)}</p>
        <div class="fields">
          ${e.needs.map(e=>this.#o(e,!0))} ${e.may.map(e=>this.#o(e,!1))}
          ${n.map(e=>this.#o(e,!1))}
        </div>
        <div class="row"><span class="grow"></span><button ?disabled=${!this.usable}>Add</button></div>
      </form>
    `}#o(e,n){let r=`${e===`at`?`begins in`:b(e)}${v[e]?` (${v[e]})`:``}`,i=this.#s(e);return i?t`<label>${r}<select name=${e}>
        ${n?p:t`<option value="">any</option>`}
        ${i.map(e=>t`<option>${e}</option>`)}</select></label>`:t`<label>${r}<input name=${e} type="text" class="number" autocomplete="off" ?required=${n} /></label>`}#s(e){switch(e){case`axis`:return this.catalog.axes;case`pin`:return this.catalog.pins.filter(({kind:e})=>e!==`output`&&e!==`analog_output`).map(({name:e})=>e);case`port`:return[`usb`,`rs485`,`can`];case`way`:return[`in`,`out`];case`value`:return[`true`,`false`];default:return null}}#c(e){e.preventDefault();let t={kind:this.kind};for(let[i,a]of new FormData(e.target)){let e=String(a).trim();if(e===``)continue;let o=_.includes(i)?e:i===`value`?e===`true`:n(e);if(o===null){r(`${b(i)}: “${e}” is not a number.`,`error`);return}t[i]=o}this.#i(()=>this.api.addFault(this.device.name,t))}};customElements.define(`pt-faults`,y);function b(e){return e.replaceAll(`_`,` `)}var x=[-100,-10,-1,1,10,100];function S(e){return e.parameters.some(({role:e})=>e===`pulser_enable`)}var C=class extends m{static properties={...m.properties,axis:{state:!0}};static styles=[c,f`
      .steps {
        display: grid;
        grid-template-columns: repeat(${x.length}, 1fr);
        gap: 6px;
      }
      button {
        padding: 3px 4px;
      }
      p {
        font-size: 13px;
      }
    `];willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.axis=this.catalog.axes[0]??``)}render(){return t`
      <section class="panel stack" aria-label="Hand wheel">
        <div class="row"><h2 class="grow">Hand wheel</h2>
          ${h(this.catalog.axes,this.axis,`wheel-axis`,e=>this.axis=e)}
        </div>
        <p class="muted">Counts of the manual pulse generator; the axis follows where ${this.#e} is 1.</p>
        <div class="steps">
          ${x.map(e=>t`<button ?disabled=${!this.usable} @click=${()=>this.#t(e)}>
            ${e>0?`+${e}`:`−${-e}`}</button>`)}
        </div>
      </section>
    `}get#e(){return this.catalog.parameters.find(({role:e,axis:t})=>e===`pulser_enable`&&t===this.axis)?.id??``}#t(e){d(()=>this.api.turnPulser(this.device.name,this.axis,e))}};customElements.define(`pt-hand-wheel`,C);var w=60,T=class{#e;#t;#n;#r=null;#i=!1;constructor(e,t,n){this.#e=e,this.#t=t,this.#n=n}set(e){this.#r=e,this.#i||this.#a()}async#a(){this.#i=!0;let e;for(;e!==this.#r;){e=this.#r;let t=e;if(!await d(()=>t===null?this.#e.releasePin(this.#t,this.#n):this.#e.drivePin(this.#t,this.#n,t)))break;await new Promise(e=>window.setTimeout(e,w))}this.#i=!1}},E=56,D={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]};function O(e){return e.pins.filter(({kind:e,role:t,low:n,high:r})=>e===`analog`&&t===`joystick`&&n!==null&&r!==null).slice(0,2)}var k=class extends m{static properties={...m.properties,at:{state:!0}};#e=[];#t=!1;static styles=[c,f`
      svg {
        display: block;
        margin: 0 auto;
        touch-action: none;
        cursor: grab;
      }
      .field {
        fill: var(--raised);
        stroke: var(--strong-line);
      }
      .cross {
        stroke: var(--line);
      }
      .stick {
        fill: var(--accent);
      }
      p {
        font-size: 13px;
      }
    `];constructor(){super(),this.at=[0,0]}willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.#e=O(this.catalog).map(({name:e})=>new T(this.api,this.device.name,e)))}disconnectedCallback(){super.disconnectedCallback(),this.#o()}render(){let e=O(this.catalog),n=this.catalog.parameters.find(({group:e,axis:t,high:n})=>e===`Joystick`&&t===null&&n===3),[r,i]=this.at;return t`
      <section class="panel stack" aria-label="Joystick">
        <h2>Joystick</h2>
        <p class="muted">${e.map(({name:e,axis:t})=>`${e}${t?` for ${t}`:``}`).join(`, `)}. It springs back; arrow keys bend it.
          ${n?t`The axes follow where <code>${n.id}</code> has their bit, as fast and as far as the other parameters
            of “${n.group}” let them: <a href=${o(this.device.name,`parameters`)}>Parameters</a>.`:p}</p>
        <svg width="150" height="150" viewBox="-75 -75 150 150" tabindex="0" role="application"
          aria-label="Joystick of ${e.map(({name:e})=>e).join(` and `)}"
          @pointerdown=${this.#n} @pointermove=${this.#r} @pointerup=${this.#o} @pointercancel=${this.#o}
          @keydown=${this.#i} @keyup=${this.#o} @blur=${this.#o}>
          <circle class="field" r="72" />
          <line class="cross" x1="-72" x2="72" /><line class="cross" y1="-72" y2="72" />
          <circle class="stick" r="15" cx=${r*E} cy=${-i*E} />
        </svg>
      </section>
    `}#n(e){e.button===0&&this.usable&&(e.currentTarget.setPointerCapture(e.pointerId),this.#t=!0,this.#r(e))}#r(e){if(!this.#t)return;let t=e.currentTarget.getBoundingClientRect(),n=(e.clientX-t.x-t.width/2)/E,r=-(e.clientY-t.y-t.height/2)/E,i=Math.max(1,Math.hypot(n,r));this.#a([n/i,r/i])}#i(e){let t=D[e.key];t&&this.usable&&(e.preventDefault(),this.#t=!0,e.repeat||this.#a(t))}#a(e){this.at=e,O(this.catalog).forEach(({low:t,high:n},r)=>{this.#e[r].set(Math.round((t+n)/2+e[r]*(n-t)/2))})}#o(){if(this.#t){this.#t=!1,this.at=[0,0];for(let e of this.#e)e.set(null)}}};customElements.define(`pt-joystick`,k);var A=class{#e;#t;#n;#r=!1;#i=Promise.resolve();constructor(e,t,n){this.#e=e,this.#t=t,this.#n=n}get pressed(){return this.#r}set(e){e!==this.#r&&(this.#r=e,this.#i=this.#i.then(()=>d(()=>e?this.#a():this.#o())))}async#a(){let e=await this.#e.pin(this.#t,this.#n);await this.#e.drivePin(this.#t,this.#n,e===!1||e===0)}#o(){return this.#e.releasePin(this.#t,this.#n)}},j=1.5,M=class extends m{static properties={...m.properties,axis:{type:String},load:{type:Number}};static styles=[c,f`
      :host {
        display: grid;
        grid-template-columns: minmax(180px, 1fr) auto;
        gap: 6px 18px;
        align-items: center;
      }
      .load {
        display: grid;
        grid-template-columns: auto 1fr 4em;
        gap: 8px;
        align-items: center;
        font-size: 13px;
      }
      output {
        text-align: right;
      }
      form input {
        width: 90px !important;
      }
      @media (max-width: 600px) {
        :host {
          grid-template-columns: 1fr;
        }
      }
    `];render(){return t`
      <div class="load">
        <label for="load">Load</label>
        <input id="load" type="range" min="0" max=${j} step="0.01" .value=${String(this.load)} ?disabled=${!this.usable}
          aria-label="Load of axis ${this.axis}" title="Part of the motor's pull-out torque; above 1 it stalls"
          @change=${e=>this.#e(Number(e.target.value))} />
        <output class=${this.load>1?`error-text`:``}>${Math.round(this.load*100)} %</output>
      </div>
      <form class="row" @submit=${this.#t}>
        <input name="pulses" class="number" type="text" inputmode="numeric" value="100" aria-label="Pulses, axis ${this.axis}" />
        <button class="small" value="push" ?disabled=${!this.usable} title="Turn the shaft by hand; less than 0 is backwards">Push</button>
        <button class="small" value="lose" ?disabled=${!this.usable} title="The motor does not follow its next pulses">Lose</button>
      </form>
    `}#e(e){d(()=>this.api.setLoad(this.device.name,this.axis,e))}#t(e){e.preventDefault();let t=s(String(new FormData(e.target).get(`pulses`))),n=e.submitter?.value===`lose`;if(t===null||n&&t<1){r(n?`So many pulses cannot be lost.`:`Pulses are a whole number.`,`error`);return}let{name:i}=this.device,{axis:a}=this;d(()=>n?this.api.lose(i,a,t):this.api.push(i,a,t),n?`The next ${t} pulses of ${a} are lost`:`${a} pushed by ${t}`)}};customElements.define(`pt-by-hand`,M);var N=46,P=1e4;function F(e,t){let n=[e.negative_limit,e.positive_limit,...e.home??[]].filter(e=>e!==null);if(e.negative_limit===null||e.positive_limit===null){let t=Math.round(e.shaft/P)*P;n.push(t-P,t+P)}let r=Math.min(...n,e.shaft),i=Math.max(...n,e.shaft),a=(t-92)/Math.max(1,i-r);return{margin:N,low:r,high:i,perPulse:a,x:e=>N+(e-r)*a,pulse:e=>r+(e-N)/a}}function I(e,t){let n=e.circumference;return(t%n+n)%n/n}function L(e,[t,n],r){let i=e=>{let t=e*2*Math.PI;return`${(Math.sin(t)*r).toFixed(2)} ${(-Math.cos(t)*r).toFixed(2)}`},a=Math.min(.999,Math.max((n-t)/e.circumference,.01)),o=I(e,t);return`M ${i(o)} A ${r} ${r} 0 ${+(a>.5)} 1 ${i(o+a)}`}function R({home:e,negative_limit:t,positive_limit:n},r){switch(r){case`negative limit`:return t;case`positive limit`:return n;case`home`:return e&&(e[0]+e[1])/2}}function z(e,t,n){let r=Math.round(e.circumference===null?n:I(e,n)*e.circumference);switch(t){case`negative limit`:return{negative_limit:r};case`positive limit`:return{positive_limit:r};case`home`:{let t=e.home[1]-e.home[0],n=r-Math.floor(t/2);return{home:[n,n+t]}}}}function B(e,t){let{shaft:n,home:r,negative_limit:i,positive_limit:a}=e;switch(t){case`negative limit`:return i!==null&&n<=i;case`positive limit`:return a!==null&&n>=a;case`home`:return r===null?!1:e.circumference===null?r[0]<=n&&n<=r[1]:(I(e,n)-I(e,r[0])+1)%1<=(r[1]-r[0])/e.circumference}}function V(e,t,n){let r=e.home?Math.max(1,(e.home[1]-e.home[0])/2):1;if(e.circumference!==null){let t=Math.abs(I(e,n)-I(e,e.shaft)),i=Math.max(r/e.circumference,.01);return Math.min(t,1-t)<=i}if(t===`negative limit`)return e.shaft<=n;if(t===`positive limit`)return e.shaft>=n;let i=(e.positive_limit??0)-(e.negative_limit??0);return Math.abs(e.shaft-n)<=Math.max(r,i/100)}var H=f`
  .axis + .axis {
    margin-top: 10px;
    padding-top: 10px;
    border-top: 1px solid var(--line);
  }
  .head {
    font-size: 13px;
  }
  svg {
    display: block;
    width: 100%;
    font-size: 11px;
    font-variant-numeric: tabular-nums;
    touch-action: pan-y;
  }
  text {
    fill: var(--muted);
  }
  .rail {
    stroke: var(--strong-line);
    stroke-width: 4;
    stroke-linecap: round;
    fill: none;
  }
  .mark {
    stroke: var(--line);
    stroke-width: 1.5;
  }
  .home {
    fill: var(--ok);
    opacity: 0.75;
  }
  .home-arc {
    stroke: var(--ok);
    stroke-width: 6;
    fill: none;
  }
  .carriage {
    fill: var(--accent);
  }
  .slack {
    fill: var(--accent);
    opacity: 0.25;
  }
  .hand {
    stroke: var(--accent);
    stroke-width: 4;
    stroke-linecap: round;
  }
  .switch {
    cursor: grab;
    touch-action: none;
    user-select: none;
    outline: none;
  }
  .switch .body {
    fill: var(--panel);
    stroke: var(--strong-line);
    stroke-width: 2;
  }
  .switch text {
    fill: var(--text);
    font-weight: 650;
    text-anchor: middle;
  }
  .switch.on .body {
    fill: var(--ok);
    stroke: var(--ok);
  }
  .switch.on.limit .body {
    fill: var(--error);
    stroke: var(--error);
  }
  .switch.on .body + text {
    fill: var(--panel);
  }
  .hit {
    fill: transparent;
  }
  .switch:focus-visible .body {
    stroke: var(--accent);
    stroke-width: 3;
  }
`,U=80,W=.35,G=88,K=38,q=172,J=48,Y=5,X=[`negative limit`,`home`,`positive limit`],Z={"negative limit":`−L`,home:`H`,"positive limit":`+L`},Q=class extends m{static properties={...m.properties,machine:{state:!0},width:{state:!0},drag:{state:!0},problem:{state:!0},mounting:{state:!0}};watches=[`status`];#e=0;#t=0;#n=new Map;#r=new ResizeObserver(([e])=>{e&&e.contentRect.width>0&&(this.width=e.contentRect.width)});static styles=[c,H];constructor(){super(),this.machine=null,this.width=600,this.drag=null,this.problem=null,this.mounting=!1}connectedCallback(){super.connectedCallback(),this.#i(),this.#o()}disconnectedCallback(){super.disconnectedCallback(),clearTimeout(this.#e),cancelAnimationFrame(this.#t),this.#r.disconnect(),this.#S()}firstUpdated(){this.#r.observe(this)}async#i(){if(this.active&&!document.hidden)try{this.machine=await this.api.machine(this.device.name),this.problem=null,this.#a()}catch(e){this.problem=i(e)}this.isConnected&&(this.#e=window.setTimeout(()=>void this.#i(),this.problem?1e3:U))}#a(){let{drag:e}=this,t=e&&this.machine?.axes[e.axis];e?.press&&t&&e.press.set(V(t,e.role,e.at)!==B(t,e.role))}#o(){this.#t=requestAnimationFrame(()=>{if(this.#o(),this.active&&this.machine)for(let[e,t]of Object.entries(this.machine.axes)){let n=this.#n.get(e)??t.shaft,r=t.shaft-n,i=Math.abs(r)<.5?t.shaft:n+r*W;this.#n.set(e,i),this.renderRoot.querySelector(`[data-shaft="${e}"]`)?.setAttribute(`transform`,this.#s(t,i))}})}#s(e,t){return e.circumference===null?`translate(${F(e,this.width).x(t).toFixed(2)} 0)`:`rotate(${(I(e,t)*360).toFixed(2)})`}render(){return this.machine?t`
      <section class="panel stack" aria-label="Machine">
        <div class="row"><h2>Machine</h2>
          <span class="muted grow">${this.mounting?`Drag a switch to where it is to be, or move it with the arrow keys; with Shift in small steps.`:`Drag a switch to the carriage to press it, or hold the space bar on it.`}</span>
          <button class="small" aria-pressed=${this.mounting} ?disabled=${!this.usable}
            @click=${()=>this.mounting=!this.mounting}>Move switches</button>
        </div>
        <div>
          ${this.#c().map(([e,n])=>t`
            <div class="axis">
              <div class="row head"><strong>${e}</strong>
                <span class="muted">shaft ${l(n.shaft)} · counter ${l(this.live.status?.axes[e]?.position)}
                  ${n.index_every?`· an index mark every ${l(n.index_every)}`:p}
                  ${n.backlash?`· backlash ${l(n.backlash)}`:p}</span>
              </div>
              ${n.circumference===null?this.#l(e,n):this.#d(e,n)}
              <pt-by-hand .axis=${e} .load=${n.load} ${this.given()}></pt-by-hand>
            </div>`)}
        </div>
      </section>
    `:t`<section class="panel"><h2>Machine</h2>
        <p class=${this.problem?`error-text`:`muted`}>${this.problem??`Loading…`}</p></section>`}#c(){return this.catalog.axes.flatMap(e=>{let t=this.machine?.axes[e];return t?[[e,t]]:[]})}#l(n,r){let i=F(r,this.width),a=r.backlash*i.perPulse;return t`
      <svg viewBox="0 0 ${this.width} ${G}" height=${G} role="group"
        aria-label="Stage of axis ${n}, from ${r.negative_limit??`no limit`} to ${r.positive_limit??`no limit`}">
        <line class="rail" x1=${i.margin} x2=${this.width-i.margin} y1=${K} y2=${K} />
        ${this.#u(r,i)}
        ${r.home?e`<rect class="home" x=${i.x(r.home[0])} y=${35} height="6" rx="1"
              width=${Math.max(3,i.x(r.home[1])-i.x(r.home[0]))} />`:p}
        <g data-shaft=${n} transform=${this.#s(r,this.#n.get(n)??r.shaft)}>
          ${a>=1?e`<rect class="slack" x=${-14-a/2} y=${8} width=${28+a} height="24" rx="4" />`:p}
          <rect class="carriage" x="-14" y=${8} width="28" height="24" rx="4" />
          <path class="carriage" d="M -5 ${31} L 5 ${31} L 0 ${37} Z" />
        </g>
        ${X.map(e=>this.#f(n,r,e,i))}
      </svg>
    `}#u(t,n){let r=t.index_every;if(!r||r*n.perPulse<Y)return p;let i=Math.ceil(n.low/r),a=Math.floor(n.high/r)-i+1;return Array.from({length:a},(t,a)=>{let o=n.x((i+a)*r);return e`<line class="mark" x1=${o} x2=${o} y1=${42} y2=${48} />`})}#d(n,r){let{width:i}=this,a=r.index_every??0,o=a>0?Math.min(360,Math.floor(r.circumference/a)):0;return t`
      <svg viewBox="${-i/2} ${-86} ${i} ${q}" height=${q} role="group"
        aria-label="Shaft of axis ${n}, ${r.circumference} to the turn">
        <circle class="rail" r=${J} />
        ${Array.from({length:o},(t,n)=>e`<line class="mark" transform="rotate(${I(r,n*a)*360})" y1=${-43} y2=${-37} />`)}
        ${r.home?e`<path class="home-arc" d=${L(r,r.home,J)} />`:p}
        <g data-shaft=${n} transform=${this.#s(r,this.#n.get(n)??r.shaft)}>
          <line class="hand" y1="8" y2=${-41} /><circle class="carriage" r="7" />
        </g>
        ${X.map(e=>this.#p(n,r,e))}
        <text x=${92} y="4">${l(r.circumference)} a turn</text>
      </svg>
    `}#f(t,n,r,i){let a=R(n,r);if(a===null||!this.#_(t,r))return p;let o=this.#g(t,r),s=i.x(o??a),c=this.mounting?Math.round(o??a):o===null?a:null;return this.#m(t,r,`translate(${s} 62)`,e=>i.pulse(this.#h(e)),e`
      <path class="body" d="M 0 -20 L 5 -12 L 15 -12 L 15 10 L -15 10 L -15 -12 L -5 -12 Z" />
      <text y="4">${Z[r]}</text>`,c===null?p:e`<text y="24">${l(c)}</text>`)}#p(t,n,r){let i=R(n,r);if(i===null||!this.#_(t,r))return p;let a=I(n,this.#g(t,r)??i)*2*Math.PI,o=`translate(${Math.sin(a)*66} ${-Math.cos(a)*66})`;return this.#m(t,r,o,e=>{let t=e.currentTarget.ownerSVGElement.getBoundingClientRect();return Math.atan2(e.clientX-t.x-t.width/2,-(e.clientY-t.y-t.height/2))/(2*Math.PI)*n.circumference},e`<circle class="body" r="12" /><text y="4">${Z[r]}</text>`,p)}#m(t,n,r,i,a,o){let s=this.#v(t,n),c=e=>{this.mounting?e.type===`keydown`&&this.#C(e,t,n):(e.key===` `||e.key===`Enter`)&&(e.preventDefault(),e.repeat||(e.type===`keydown`?this.#x(t,n):this.#S()))};return e`
      <g class="switch ${s?`on`:``} ${n===`home`?``:`limit`}" transform=${r} tabindex="0" role="button"
        aria-label="${n} switch of ${t}, ${s?`on`:`off`}" aria-pressed=${s?`true`:`false`}
        @pointerdown=${e=>this.#y(e,t,n,i(e))}
        @pointermove=${e=>this.#b(t,n,()=>i(e))}
        @pointerup=${()=>this.#S()} @pointercancel=${()=>this.#S()} @lostpointercapture=${()=>this.#S()}
        @keydown=${c} @keyup=${c} @blur=${()=>this.#S()}>
        <rect class="hit" x="-23" y="-20" width="46" height="46" />${a} ${o}
      </g>
    `}#h(e){return e.clientX-e.currentTarget.ownerSVGElement.getBoundingClientRect().x}#g(e,t){let{drag:n}=this;return n?.axis===e&&n.role===t?n.at:null}#_(e,t){return this.catalog.pins.find(n=>n.axis===e&&n.role===t)?.name??null}#v(e,t){let n=this.live.status?.axes[e];return{"negative limit":n?.negative_limit,"positive limit":n?.positive_limit,home:n?.home}[t]??!1}#y(e,t,n,r){let i=this.#_(t,n);e.button===0&&i&&this.usable&&(e.currentTarget.setPointerCapture(e.pointerId),this.drag={axis:t,role:n,at:r,press:this.mounting?null:new A(this.api,this.device.name,i)},this.#a())}#b(e,t,n){this.#g(e,t)!==null&&(this.drag={...this.drag,at:n()},this.#a())}#x(e,t){let n=this.#_(e,t),r=this.machine?.axes[e]?.shaft;n&&r!==void 0&&this.usable&&(this.drag={axis:e,role:t,at:r,press:new A(this.api,this.device.name,n)},this.#a())}#S(){let{drag:e}=this;this.drag=null,e?.press?e.press.set(!1):e&&this.#w(e.axis,e.role,e.at)}#C(e,t,n){let r=this.machine?.axes[t],i=r&&R(r,n),a={ArrowLeft:-1,ArrowDown:-1,ArrowRight:1,ArrowUp:1}[e.key];if(!r||i==null||a===void 0||!this.usable)return;e.preventDefault();let{low:o,high:s}=F(r,this.width),c=(r.circumference??s-o)/(e.shiftKey?1e4:100);this.#w(t,n,i+a*Math.max(1,Math.round(c)))}async#w(e,t,n){let r=this.machine?.axes[e];r&&(await d(()=>this.api.moveSwitches(this.device.name,{axis:e,...z(r,t,n)})),this.machine=await this.api.machine(this.device.name).catch(()=>this.machine))}};customElements.define(`pt-machine`,Q);var $=class extends m{static properties={...m.properties,keep:{state:!0},driven:{state:!0}};watches=[`status`];#e=new Map;#t=new Map;static styles=[c,f`
      .tiles {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(104px, 1fr));
        gap: 6px;
      }
      .tile {
        display: flex;
        align-items: center;
        justify-content: flex-start;
        gap: 7px;
        min-height: 34px;
        padding: 2px 9px;
        border: 1px solid var(--line);
        border-radius: var(--radius);
        background: var(--raised);
        overflow: hidden;
        text-align: left;
        touch-action: none;
      }
      button.tile {
        border-color: var(--strong-line);
      }
      .tile i {
        flex: none;
        width: 11px;
        height: 11px;
        border: 2px solid var(--strong-line);
        border-radius: 50%;
      }
      .tile.on i {
        border-color: var(--ok);
        background: var(--ok);
      }
      .tile.on {
        font-weight: 650;
      }
      .tile.driven {
        border-color: var(--accent);
        box-shadow: inset 0 0 0 1px var(--accent);
      }
      .tile small {
        display: block;
        color: var(--muted);
        font-weight: 400;
        font-size: 11px;
        line-height: 12px;
      }
      .tile span {
        line-height: 16px;
      }
      .analog {
        display: grid;
        grid-template-columns: auto minmax(60px, 1fr) auto 34px;
        gap: 6px 10px;
        align-items: center;
      }
      .analog input {
        width: 100%;
        min-width: 0;
      }
      .analog output {
        min-width: 5em;
        text-align: right;
      }
      .sub {
        margin: 2px 0 4px;
      }
    `];constructor(){super(),this.keep=!1,this.driven=new Map}disconnectedCallback(){super.disconnectedCallback();for(let e of this.#e.values())e.set(!1)}get#n(){return this.device.kind===`virtual`}render(){let{pins:e}=this.catalog,n=this.live.status?.outputs??{},r=e=>e.kind===`output`||e.kind===`port`&&e.name in n,i=e.filter(e=>[`input`,`index`,`port`].includes(e.kind)&&!r(e)),a=e.filter(e=>e.kind===`analog`),o=e.filter(e=>e.kind===`analog_output`);return t`
      <section class="panel stack" aria-label="Inputs and outputs">
        <div class="row"><h2 class="grow">Inputs</h2>
          ${this.#n?t`<label class="line" title="A click presses, another one lets go">
                <input type="checkbox" .checked=${this.keep} @change=${e=>this.keep=e.target.checked} />
                keep pressed</label>`:p}
        </div>
        ${this.#r(i)}
        <h2>Outputs</h2>
        <div class="tiles">${e.filter(r).map(e=>this.#c(e))}</div>
        ${a.length+o.length>0?t`<h2>Analog</h2>
              <div class="analog">${a.map(e=>this.#l(e))} ${o.map(e=>this.#p(e))}</div>`:p}
      </section>
    `}#r(e){return[null,...this.catalog.axes].map(n=>{let r=e.filter(e=>this.#i(e)===n);return r.length===0?p:t`
        <div>
          ${n===null?p:t`<h3 class="sub">Axis ${n}</h3>`}
          <div class="tiles">${r.map(e=>this.#o(e))}</div>
        </div>
      `})}#i({axis:e,name:t,kind:n}){if(e!==null)return e;let r=t.at(-1)??``;return n===`input`&&/[A-Z]/.test(r)&&t.length>3&&this.catalog.axes.includes(r)?r:null}#a(e){let t=this.live.status?.inputs[e.name];if(t!==void 0)return t===!0||typeof t==`number`&&t!==0;let n=e.axis===null?void 0:this.live.status?.axes[e.axis];if(!n)return null;switch(e.role){case`negative limit`:return n.negative_limit;case`positive limit`:return n.positive_limit;case`home`:return n.home;case`index`:return n.index;default:return null}}#o(e){let n=this.#a(e),r=this.#e.get(e.name),i=`${e.name}${e.role?`, ${e.role}`:``}${n===null?``:n?`, on`:`, off`}`,a=t`<i></i><span>${e.name} ${e.role?t`<small>${e.role}</small>`:p}</span>`,o=`tile ${n?`on`:``} ${r?.pressed?`driven`:``}`;if(!this.#n)return t`<div class=${o} role="img" aria-label=${i} title=${i}>${a}</div>`;let s=()=>{this.keep||this.#s(e.name,!1)};return t`
      <button class=${o} title=${i} aria-label=${i} aria-pressed=${r?.pressed??!1} ?disabled=${!this.usable}
        @pointerdown=${t=>{t.button===0&&(this.keep||t.currentTarget.setPointerCapture(t.pointerId),this.#s(e.name,!this.keep||!r?.pressed))}}
        @pointerup=${s} @pointercancel=${s} @blur=${s} @contextmenu=${e=>e.preventDefault()}
        @keydown=${t=>{t.repeat||t.key!==` `&&t.key!==`Enter`||(t.preventDefault(),this.#s(e.name,!this.keep||!r?.pressed))}}
        @keyup=${s}>${a}</button>
    `}#s(e,t){let n=this.#e.get(e)??new A(this.api,this.device.name,e);this.#e.set(e,n),n.set(t),this.requestUpdate()}#c(e){let n=this.live.status?.outputs[e.name],r=n===!0||typeof n==`number`&&n!==0,i=n!==void 0&&this.catalog.actions.includes(`output`);return t`
      <button class="tile ${r?`on`:``}" role="switch" aria-checked=${r} ?disabled=${!this.usable||!i}
        title="${e.name}${e.role?`, ${e.role}`:``}: ${i?r?`on`:`off`:`cannot be set from here`}"
        @click=${()=>d(()=>this.api.act(this.device.name,{do:`output`,name:e.name,value:!r}))}>
        <i></i><span>${e.name} ${e.role?t`<small>${e.role}</small>`:p}</span>
      </button>
    `}#l(e){let n=this.live.status?.inputs[e.name],r=typeof n==`number`?n:this.driven.get(e.name)??null,i=this.#n&&e.low!==null&&e.high!==null;return t`
      <span>${e.name} <small class="muted">${e.role}</small></span>
      ${i?t`<input type="range" min=${e.low} max=${e.high} step=${e.high-e.low>200?1:.1} ?disabled=${!this.usable}
            aria-label="${e.name}${e.role?`, ${e.role}`:``}" .value=${String(this.driven.get(e.name)??r??e.low)}
            @input=${t=>this.#u(e.name,Number(t.target.value))} />`:t`<span></span>`}
      <output>${u(r)} ${e.unit}</output>
      ${i?t`<button class="small plain" ?disabled=${!this.driven.has(e.name)} title="Give it back to the machine"
            aria-label="Give ${e.name} back to the machine" @click=${()=>this.#d(e.name)}>✕</button>`:t`<span></span>`}
    `}#u(e,t){this.driven=new Map(this.driven).set(e,t),this.#f(e).set(t)}#d(e){let t=new Map(this.driven);t.delete(e),this.driven=t,this.#f(e).set(null)}#f(e){let t=this.#t.get(e)??new T(this.api,this.device.name,e);return this.#t.set(e,t),t}#p(e){let n=this.live.status?.outputs[e.name],r=typeof n==`number`?n:null;return t`
      <span>${e.name} <small class="muted">${e.role}</small></span>
      <input type="range" min=${e.low??0} max=${e.high??100} step="1" aria-label=${e.name} ?disabled=${!this.usable}
        .value=${String(r??0)}
        @change=${t=>d(()=>this.api.act(this.device.name,{do:`output`,name:e.name,value:Number(t.target.value)}))} />
      <output>${u(r)} ${e.unit}</output><span></span>
    `}};customElements.define(`pt-pins`,$);var ee=class extends m{static styles=[c,f`
      :host {
        display: grid;
        grid-template-columns: repeat(2, minmax(0, 1fr));
        gap: var(--gap);
        align-items: start;
      }
      .wide {
        grid-column: 1 / -1;
      }
      @media (max-width: 900px) {
        :host {
          grid-template-columns: minmax(0, 1fr);
        }
      }
    `];render(){let e=this.device.kind===`virtual`;return t`
      ${e?t`<pt-machine class="wide" ${this.given()}></pt-machine>`:p}
      <pt-pins class=${e?``:`wide`} ${this.given()}></pt-pins>
      ${e?t`<div class="stack">
            <pt-faults ${this.given()}></pt-faults>
            ${O(this.catalog).length>0?t`<pt-joystick ${this.given()}></pt-joystick>`:p}
            ${S(this.catalog)?t`<pt-hand-wheel ${this.given()}></pt-hand-wheel>`:p}
          </div>`:p}
    `}};customElements.define(`pt-io`,ee);